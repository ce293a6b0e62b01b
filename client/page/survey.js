// Which tool fits.
import {api} from './api.js';
import {fail, mark} from './found.js';
import {redraw} from './picture.js';
import {inPlane} from './planes.js';
import {$, isOwnPlane, shown, withUnit} from './shown.js';
import {t} from './texts.js';

async function survey() {
  const program = shown.current, {view} = program;
  $('survey').disabled = true;
  $('largest').textContent = t('working');
  let answer = null;
  try {
    answer = await api.survey(program, program.settings, view.toolRadius ?? 0);
  } catch (error) { await fail(error, program); }
  if (shown.current !== program || program.view !== view) return;
  $('survey').disabled = false;
  $('largest').replaceChildren(...(answer ? surveyed(answer, view) : []));
  program.uncut = !isOwnPlane(view) ? [] : (answer?.radii?.[0]?.uncut ?? []).map(({start, end, center, sweep}) => (
    {from: inPlane(view.plane, start ?? {}), to: inPlane(view.plane, end ?? {}), ...(center && sweep && {center: inPlane(view.plane, center), sweep})}));
  redraw();
}

function surveyed({radii = [], summary}, view) {
  const largest = summary?.largest ?? {};
  const head = document.createElement('strong');
  head.textContent = !largest.radius ? t('largestNone')
    : `${t('largestIs')} ${largest.isLimited ? '' : `${t('atLeast')} `}${withUnit(largest.radius)}`;
  const parts = [head];
  (largest.limits ?? []).filter(place => place.line).forEach((place, i) => {
    const button = document.createElement('button');
    button.textContent = `${t('line')} ${place.line}`;
    button.addEventListener('click', () => mark(place.line, true));
    parts.push(i === 0 ? `, ${t('limitedBy')} ` : ' ', button);
  });
  const [own] = radii;
  if (own?.wallLength) {
    const uncut = document.createElement('p');
    uncut.textContent = `${withUnit(own.uncutLength)} ${t('of')} ${withUnit(own.wallLength)} ${t('uncut', {radius: withUnit(view.toolRadius)})}`;
    parts.push(uncut);
  }
  return parts;
}
$('survey').addEventListener('click', survey);
