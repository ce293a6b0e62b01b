import {settingMeaning, settingName, settingWord} from './settings_texts.js';
import {currentLanguage, t} from './texts.js';

// The settings of the server as a form: what there is, and what it means, comes from its OpenAPI
// document.
const mainSettings = ['tool_radius', 'dialect', 'unit', 'wear', 'tools', 'selection_mode', 'transition', 'contour_masking'];
export const notForPeople = ['language', 'response_layout', 'client_tag', 'want_resume_tokens', 'name', 'decimals', 'shown_plane'];

const unitOf = parameter => (parameter['x-unit'] ? `, ${settingWord(parameter['x-unit'], currentLanguage())}` : '');
const titleOf = (name, parameter) => settingName(name, currentLanguage()) + unitOf(parameter);

const isNumber = ({schema}) => schema.type === 'number' || schema.type === 'integer';
// Empty where there is none that matters.
const rangeOf = ({schema: {minimum, maximum}}) => (minimum !== undefined && maximum < 1e5 ? `${minimum} … ${maximum}` : '');
const takenBy = parameter => {
  const {minimum, maximum} = parameter.schema;
  return minimum !== undefined && maximum !== undefined ? `${minimum} … ${maximum}` : settingWord(parameter['x-values'], currentLanguage());
};

// What is said below a setting: its meaning, what it takes, and what holds where it is not set.
function noteOf(parameter, isChoice) {
  const language = currentLanguage(), {default: initial} = parameter.schema;
  const takes = parameter['x-values'];
  return [
    settingMeaning(parameter['x-meaning'], language),
    rangeOf(parameter),
    isChoice || isNumber(parameter) ? '' : settingWord(takes, language),
    initial === undefined ? '' : t('initially', {value: settingWord(String(initial), language)}),
  ].filter(Boolean).join('; ');
}

export class Options {
  constructor(form, openApi) {
    const parameters = openApi.paths['/v1/views'].post.parameters
      .filter(p => p.in === 'query' && !notForPeople.includes(p.name));
    this.others = {};
    this.inputs = new Map();
    this.parameters = new Map();
    this.translations = [];
    this.about = form.querySelector('#about');
    this.translations.push(() => { this.about.textContent = t('aboutSettings'); });
    const orderOf = ({name}) => (mainSettings.indexOf(name) + 1) || mainSettings.length + 1;
    for (const parameter of [...parameters].sort((a, b) => orderOf(a) - orderOf(b))) {
      const place = form.querySelector(mainSettings.includes(parameter.name) ? '#main-settings' : '#more-settings');
      place.append(this.label(parameter));
    }
    this.translate();
  }

  label(parameter) {
    const {name} = parameter;
    const label = document.createElement('label');
    const title = document.createElement('span');
    const note = document.createElement('small');
    const input = this.input(parameter);
    input.name = name;
    input.autocomplete = 'off';
    // A screen reader says the title, and what it means after it.
    title.id = `title-${name}`;
    note.id = `note-${name}`;
    input.setAttribute('aria-labelledby', title.id);
    input.setAttribute('aria-describedby', note.id);
    this.inputs.set(name, input);
    this.parameters.set(name, parameter);
    label.append(title, input, note);
    this.translations.push(() => {
      title.textContent = titleOf(name, parameter);
      label.title = note.textContent = noteOf(parameter, input.tagName === 'SELECT');
    });
    for (const comes of ['focusin', 'pointerenter'])
      label.addEventListener(comes, () => { this.about.textContent = `${title.textContent}: ${note.textContent}`; });
    return label;
  }

  input(parameter) {
    const values = parameter['x-values'];
    const words = values === 'true or false' ? ['true', 'false'] : parameter.schema.enum ? values.split(', ') : null;
    if (!words) {
      const input = document.createElement('input');
      if (isNumber(parameter)) input.inputMode = 'decimal';
      return input;
    }
    const select = document.createElement('select');
    const unset = new Option('', '');
    select.append(unset);
    this.translations.push(() => { unset.text = t('unset'); });
    for (const word of words) {
      const option = new Option(word, word.replace(/ \(.*/, ''));
      select.append(option);
      this.translations.push(() => { option.text = settingWord(word, currentLanguage()); });
    }
    return select;
  }

  // Another value of a setting: which one, and an input that takes what it takes.
  offerOther(which, place) {
    which.replaceChildren(...[...this.inputs.keys()].map(name => new Option(name, name)));
    const name = () => {
      for (const option of which.options) option.text = titleOf(option.value, this.parameters.get(option.value));
    };
    const show = () => {
      const input = this.input(this.parameters.get(which.value));
      input.id = place.id;
      input.autocomplete = 'off';
      input.setAttribute('aria-labelledby', place.getAttribute('aria-labelledby'));
      place.replaceWith(input);
      place = input;
      this.translate();
    };
    this.translations.push(name);
    which.addEventListener('change', show);
    show();
  }

  get values() {
    const values = {...this.others};
    for (const [name, input] of this.inputs)
      if (input.value.trim() !== '') values[name] = input.value.trim();
    return values;
  }

  // What there is no input for, or no word to choose, stays as it was given.
  set values(values) {
    this.others = Object.fromEntries(Object.entries(values).filter(([name]) => !this.inputs.has(name)));
    for (const [name, input] of this.inputs) {
      const value = values[name] ?? '';
      input.value = value;
      if (input.value !== value) input.append(new Option(value, value, true, true));
    }
  }

  translate() {
    for (const say of this.translations) say();
  }

  // A value that the server does not take, and what it does.
  impossible(name, value) {
    const parameter = this.parameters.get(name);
    const point = isNumber(parameter) && /^[+-]?\d+,\d+$/.test(value);
    const takes = takenBy(parameter) + (point ? `, ${t('decimalPoint', {number: value.replace(',', '.')})}` : '');
    return t('impossible', {name: titleOf(name, parameter), value, takes});
  }

  // Marks what the server does not take, and says of the first one what it takes.
  refuse(fields) {
    let said = '';
    for (const [name, input] of this.inputs) {
      const field = fields.find(f => f.field === name || f.field.endsWith(`.${name}`));
      const text = field ? this.impossible(name, input.value) : '';
      input.setCustomValidity(text);
      if (field) { input.closest('details')?.setAttribute('open', ''); input.reportValidity(); }
      said ||= text;
    }
    return said;
  }
}
