import {settingMeaning, settingName, settingWord} from './settings_texts.js';
import {currentLanguage, t} from './texts.js';

// The settings of the server as a form: what there is comes from its OpenAPI document, what #TRC
// options mean from its info.
const mainSettings = ['tool_radius', 'dialect', 'unit', 'wear', 'tools', 'selection_mode', 'transition', 'contour_masking'];
export const notForPeople = ['language', 'response_layout', 'client_tag', 'want_resume_tokens', 'name', 'decimals', 'shown_plane'];

export class Options {
  constructor(form, openApi, info) {
    const parameters = openApi.paths['/v1/views'].post.parameters
      .filter(p => p.in === 'query' && !notForPeople.includes(p.name));
    const meanings = new Map((info.trcKeywords ?? []).map(k => [k.name.toLowerCase(), k.meaning]));
    this.inputs = new Map();
    this.descriptions = new Map();
    this.translations = [];
    const orderOf = ({name}) => (mainSettings.indexOf(name) + 1) || mainSettings.length + 1;
    for (const parameter of [...parameters].sort((a, b) => orderOf(a) - orderOf(b))) {
      const place = form.querySelector(mainSettings.includes(parameter.name) ? '#main-settings' : '#more-settings');
      place.append(this.label(parameter, meanings.get(parameter.name.replace('options.', ''))));
    }
    this.translate();
  }

  label({name, description}, meaning) {
    const label = document.createElement('label');
    const title = document.createElement('span');
    const input = this.input(description);
    input.name = name;
    input.autocomplete = 'off';
    this.inputs.set(name, input);
    this.descriptions.set(name, description);
    label.append(title, input);
    this.translations.push(language => { title.textContent = settingName(name, language); });
    const kind = input.tagName === 'INPUT' && description !== 'a number' ? description : '';
    if (description.includes('number')) input.inputMode = 'decimal';
    if (meaning || kind) {
      const small = document.createElement('small');
      label.append(small);
      this.translations.push(language => {
        small.textContent = [settingMeaning(name, meaning, language), kind && settingWord(kind, language)].filter(Boolean).join('; ');
      });
    }
    return label;
  }

  input(description) {
    const words = description === 'true or false' ? ['true', 'false']
      : /^[a-z_0-9]+( \([^)]*\))?(, [a-z_0-9]+( \([^)]*\))?)+$/.test(description) ? description.split(', ') : null;
    if (!words) return document.createElement('input');
    const select = document.createElement('select');
    const all = new Option('', '');
    select.append(all);
    this.translations.push(() => { all.text = t('all'); });
    for (const word of words) {
      const option = new Option(word, word.replace(/ \(.*/, ''));
      select.append(option);
      this.translations.push(language => { option.text = settingWord(word, language); });
    }
    return select;
  }

  // Another value of a setting: which one, and an input that takes what it takes.
  offerOther(which, place) {
    which.replaceChildren(...[...this.inputs.keys()].map(name => new Option(name, name)));
    const name = () => {
      for (const option of which.options) option.text = settingName(option.value, currentLanguage());
    };
    const show = () => {
      const input = this.input(this.descriptions.get(which.value));
      input.id = place.id;
      input.autocomplete = 'off';
      input.setAttribute('aria-labelledby', place.getAttribute('aria-labelledby'));
      place.replaceWith(input);
      place = input;
      for (const say of this.translations) say(currentLanguage());
    };
    this.translations.push(name);
    which.addEventListener('change', show);
    show();
  }

  get values() {
    const values = {};
    for (const [name, input] of this.inputs)
      if (input.value.trim() !== '') values[name] = input.value.trim();
    return values;
  }

  set values(values) {
    for (const [name, input] of this.inputs) input.value = values[name] ?? '';
  }

  translate() {
    for (const say of this.translations) say(currentLanguage());
  }

  // Marks what the server does not take.
  refuse(fields) {
    for (const [name, input] of this.inputs) {
      const field = fields.find(f => f.field.endsWith(name));
      input.setCustomValidity(field?.description ?? '');
      if (field) { input.closest('details')?.setAttribute('open', ''); input.reportValidity(); }
    }
  }
}
