import {t} from './texts.js';

// The settings of the server as a form: what there is comes from its OpenAPI document, what #TRC
// options mean from its info.
const mainSettings = ['tool_radius', 'dialect', 'unit', 'wear', 'tools', 'selection_mode', 'transition', 'contour_masking'];
const notForPeople = ['response_layout', 'client_tag', 'want_resume_tokens', 'name', 'decimals'];

export class Options {
  constructor(form, openApi, info) {
    const parameters = openApi.paths['/v1/views'].post.parameters
      .filter(p => p.in === 'query' && !notForPeople.includes(p.name));
    const meanings = new Map((info.trcKeywords ?? []).map(k => [k.name.toLowerCase(), k.meaning]));
    this.inputs = new Map();
    for (const parameter of parameters) {
      const place = form.querySelector(mainSettings.includes(parameter.name) ? '#main-settings' : '#more-settings');
      place.append(this.label(parameter, meanings.get(parameter.name.replace('options.', ''))));
    }
  }

  label({name, description}, meaning) {
    const label = document.createElement('label');
    const title = document.createElement('span');
    title.textContent = name.replaceAll('_', ' ').replace('options.', '#TRC ');
    const input = this.input(description);
    input.name = name;
    input.autocomplete = 'off';
    this.inputs.set(name, input);
    label.append(title, input);
    if (meaning || input.tagName === 'INPUT') {
      const small = document.createElement('small');
      small.textContent = [meaning, input.tagName === 'INPUT' ? description : ''].filter(Boolean).join('; ');
      label.append(small);
    }
    return label;
  }

  input(description) {
    const words = description === 'true or false' ? ['true', 'false']
      : /^[a-z_0-9]+( \([^)]*\))?(, [a-z_0-9]+( \([^)]*\))?)+$/.test(description) ? description.split(', ') : null;
    if (!words) return document.createElement('input');
    const select = document.createElement('select');
    select.append(new Option(t('all'), ''));
    for (const word of words) select.append(new Option(word, word.replace(/ \(.*/, '')));
    return select;
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
    for (const input of this.inputs.values())
      if (input.tagName === 'SELECT') input.options[0].text = t('all');
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
