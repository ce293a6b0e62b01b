// A proposal of the server as motions in the plane that is shown, and as words.
export function motionsOf(proposal, inPlane) {
  let from = inPlane(proposal.start ?? {});
  return (proposal.motions ?? []).map(({line, arc}) => {
    const to = inPlane((line ?? arc).end ?? {});
    const motion = arc ? {from, to, center: inPlane(arc.center ?? {}), sweep: arc.sweep} : {from, to};
    from = to;
    return motion;
  });
}

// "X5 Y20 → X-15 Y20 → arc R20 X5 Y0": for every control, whatever its words are.
export function textOf(proposal, motions, at, arc) {
  const ends = (proposal.motions ?? []).map((motion, i) => {
    const {from, center} = motions[i];
    const end = at((motion.line ?? motion.arc).end ?? {});
    return center ? `${arc(Math.hypot(from.x - center.x, from.y - center.y))} ${end}` : end;
  });
  return [at(proposal.start ?? {}), ...ends].join(' → ');
}
