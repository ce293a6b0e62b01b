// The axes of each plane, and what stands across it.
const axes = {PLANE_XY: ['x', 'y', 'z'], PLANE_ZX: ['z', 'x', 'y'], PLANE_YZ: ['y', 'z', 'x']};

export const planeNames = ['PLANE_XY', 'PLANE_ZX', 'PLANE_YZ'];
export const axesOf = plane => axes[plane] ?? axes.PLANE_XY;
export const inPlane = (plane, position) => ({x: position[axesOf(plane)[0]] ?? 0, y: position[axesOf(plane)[1]] ?? 0});
export const positionOf = (plane, first, second, third) => {
  const [a, b, c] = axesOf(plane);
  return {[a]: first, [b]: second, [c]: third};
};
