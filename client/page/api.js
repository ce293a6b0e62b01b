import {programInside} from './inside.js';
import {currentLanguage} from './texts.js';

// What the page asks the server. A refusal is thrown as its problem (RFC 9457).
export class Refused extends Error {
  constructor(problem) {
    super(problem.detail || problem.title || String(problem.status));
    this.problem = problem;
  }
}

async function ask(path, options = {}) {
  const answer = await fetch(path, {...options, credentials: 'omit', cache: 'default'});
  if (answer.ok) return answer;
  const type = answer.headers.get('content-type') ?? '';
  throw new Refused(type.includes('json') ? await answer.json() : {status: answer.status});
}

const json = async (path, options) => (await ask(path, options)).json();
const text = {'Content-Type': 'text/plain; charset=utf-8'};
// Messages come in the language of the page.
const query = settings => new URLSearchParams({language: currentLanguage(), ...settings}).toString();

const server = {
  info: () => json('v1/info'),
  openApi: () => json('v1/openapi.json'),
  // `plane`: xy, zx or yz is shown; else that of the first compensated block.
  makeView: (program, settings, plane, signal) =>
    json(`v1/views?${query({...settings, name: program.name, ...(plane && {shown_plane: plane})})}`, {method: 'POST', headers: text, body: program.text, signal}),
  view: id => json(`v1/views/${id}`),
  dropView: id => ask(`v1/views/${id}`, {method: 'DELETE'}).catch(() => {}),
  tile: async (id, {level, x, y, segments}, signal) =>
    (await ask(`v1/views/${id}/tiles/${level}/${x}/${y}?segments=${segments}`, {signal})).arrayBuffer(),
  lines: (id, what, from, count) => json(`v1/views/${id}/${what}?from=${from}&count=${count}`),
  blocks: (id, line) => json(`v1/views/${id}/blocks?line=${line}`),
  place: (id, share, signal) => json(`v1/views/${id}/place?share=${share}`, {signal}),
  compensated: async (program, settings) =>
    (await ask(`v1/programs:compensate?${query(settings)}`, {method: 'POST', headers: text, body: program.text})).blob(),
  record: async (program, settings) =>
    (await ask(`v1/programs:record?${query({...settings, name: program.name})}`, {method: 'POST', headers: text, body: program.text})).blob(),
  survey: (program, settings, radius) =>
    json(`v1/programs:surveyRadii?${query({...settings, ...(radius > 0 && {radii: radius, uncut: true})})}`,
      {method: 'POST', headers: text, body: program.text}),

  // The program `trc view` offers, with its settings.
  offer: async token => {
    const answer = await ask(`v1/offers/${token}`);
    const settings = Object.fromEntries(new URLSearchParams(answer.headers.get('trc-settings') ?? ''));
    const name = decodeURIComponent(answer.headers.get('trc-name') ?? 'program.nc');
    return {program: {name, text: await answer.blob()}, settings};
  },
};

export const inside = programInside();
export const api = inside ?? server;
