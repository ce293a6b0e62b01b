// The page in Debian's Chromium, driven by playwright-core: what an operator does with it.
//
//   page_test.mjs TRC_BUILD_FOLDER [SCREENSHOT_FOLDER]
import assert from 'node:assert/strict';
import {spawn, spawnSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from 'node:fs';
import {createRequire} from 'node:module';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

const top = join(import.meta.dirname ?? new URL('.', import.meta.url).pathname, '../..');
const require = createRequire(join(top, '.ci/node/'));
const {chromium} = require('playwright-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const build = process.argv[2];
const screenshots = process.argv[3];
const folder = mkdtempSync(join(tmpdir(), 'trc-page-'));

const notch = `N10 G00 X-20 Y0
N20 G42 G01 X0 Y0 F500
N30 G01 X20 Y0
N40 G01 X20 Y10
N50 G01 X24 Y10
N60 G01 X24 Y0
N70 G01 X60 Y0
N80 G40 G01 X80 Y-20
N90 M30
`;
// The path beside N30 runs through the wall N70, after a change of side.
const through = ['N10 G00 X-20 Y0 F1000', 'N20 G138 G26 G141', 'N25 G41 G01 X0 Y0', 'N30 X60', 'N40 G42 X70 Y20', 'N50 Y40',
  'N60 X30', 'N70 Y3', 'N80 X20', 'N90 Y40', 'N100 X0', 'N110 G40 X-20', 'N120 M30', ''].join('\n');

function waves(blocks) {
  const lines = ['N1 G00 X-20 Y0', 'N2 G41 G01 X0 Y0 F1000'];
  for (let i = 1; i <= blocks; ++i)
    lines.push(`G01 X${(i * 0.02).toFixed(3)} Y${(20 * Math.sin(i * 0.0005) + 0.5 * Math.sin(i * 0.05)).toFixed(4)}`);
  lines.push(`G40 G01 X${(blocks * 0.02 + 30).toFixed(3)} Y50`, 'M30', '');
  return lines.join('\n');
}

const server = spawn(`${build}/bin/trcd`, ['--listen', '127.0.0.1:0', '--http-listen', '127.0.0.1:0'], {stdio: ['ignore', 'pipe', 'inherit']});
const port = await new Promise((resolve, reject) => {
  let said = '';
  server.stdout.on('data', data => {
    const found = /"http_port":(\d+)/.exec(said += data);
    if (found) resolve(found[1]);
  });
  server.on('exit', () => reject(new Error('trcd did not start')));
});
const browser = await chromium.launch({executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-dev-shm-usage']});

async function open(options = {}) {
  const context = await browser.newContext({viewport: {width: 1400, height: 900}, locale: 'en-US', ...options});
  const page = await context.newPage();
  page.problems = [];
  page.on('pageerror', error => page.problems.push(String(error)));
  page.on('console', message => { if (message.type() === 'error') page.problems.push(message.text()); });
  page.on('request', request => {
    const url = new URL(request.url());
    if (url.protocol === 'http:' && ![`127.0.0.1:${port}`, page.own].includes(url.host)) page.problems.push(`outside: ${url}`);
  });
  if (options.no2) await page.addInitScript(() => {
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, how) { return kind === 'webgl2' ? null : get.call(this, kind, how); };
  });
  await page.goto(`http://127.0.0.1:${port}/`);
  await page.waitForSelector('body[data-ready=true]');
  return page;
}

function file(name, text) {
  const path = join(folder, name);
  writeFileSync(path, text);
  return path;
}

// Opens a program and waits for its picture.
async function show(page, path, settings = {tool_radius: '5'}) {
  for (const [name, value] of Object.entries(settings)) await page.fill(`[name="${name}"]`, value);
  await page.evaluate(() => { delete document.body.dataset.view; });
  await page.setInputFiles('#file', path);
  await page.waitForSelector('body[data-view]');
  await page.waitForSelector('body[data-complete=true]');
  await page.waitForFunction(() => document.querySelectorAll('#input [role=option]').length > 0 || document.getElementById('hint').hidden === false);
}

// The colour of the picture at a point of the plane, mm, as #rrggbb.
const colourAt = (page, x, y) => page.evaluate(async ({x, y}) => {
  const {camera} = await import('/page/picture.js');
  const [sx, sy] = camera.toScreen({x, y}), lines = document.getElementById('lines');
  const copy = Object.assign(document.createElement('canvas'), {width: lines.width, height: lines.height});
  copy.getContext('2d').drawImage(lines, 0, 0);
  const {data} = copy.getContext('2d').getImageData(sx * lines.width / camera.width, sy * lines.height / camera.height, 1, 1);
  return '#' + [...data].slice(0, 3).map(value => value.toString(16).padStart(2, '0')).join('');
}, {x, y});
const sweptColour = '#dcecf7', emptyColour = '#ffffff';

const trc = (...args) => spawnSync(`${build}/bin/trc`, args, {encoding: 'utf8'});
const tests = {
  async 'a violation leads to its line and place'(page) {
    const path = file('notch.nc', notch);
    await show(page, path);
    const said = trc('compensate', path, '--set', 'tool_radius=5').stderr;
    const [, line, code] = /notch\.nc:(\d+):.* error (\d+)/.exec(said);
    const button = page.locator('#diagnostics button.error').first();
    assert.equal(await button.getAttribute('data-code'), code, said);
    assert.match(await page.textContent('#state'), /Refused/);
    await button.click();
    const selected = page.locator('#input [aria-selected=true]');
    await selected.waitFor();
    assert.equal(await selected.locator('.number').textContent(), line);
    assert.match(await page.textContent('#output'), /refused/);
    assert.ok(await page.locator('#save-nc').isDisabled(), 'half a program is not saved');
  },

  async 'a program of another control is read as one by a click'(page) {
    await show(page, file('inch.nc', 'O1001 (A REMARK THAT IS LONGER THAN THE LISTING IS WIDE, AND IS READ ALL THE SAME)\nG20 G17 G90 G40\nG0 X-1. Y-1.\n' +
      'G41 G1 X0. Y-.5 F20.\nY1.5\nX2.\nY0.\nX-.5\nG40 X-1. Y-1.\nM30\n'));
    assert.match(await page.textContent('#state'), /nothing of it is compensated/);
    await page.click('#diagnostics .way-out');
    await page.waitForFunction(() => document.getElementById('state').textContent.startsWith('Compensated'));
    assert.equal(await page.inputValue('[name=dialect]'), 'fanuc');
    assert.equal(await page.locator('#diagnostics .way-out').count(), 0);
    assert.match(await page.textContent('#certificate'), /0\.19685 inch, needed 0\.19685 inch/);
    await page.selectOption('[name=dialect]', 'sinumerik');
    await page.click('#compute');
    await page.waitForFunction(() => /G20/.test(document.getElementById('diagnostics').textContent));
    await page.click('#diagnostics .way-out');
    await page.waitForFunction(() => document.getElementById('state').textContent.startsWith('Compensated'));
    // A coordinate and a number with its unit are not parted; a long line is marked as far as it goes.
    const heights = await page.evaluate(() => [...document.querySelectorAll('#certificate dd span')].map(part => part.getClientRects().length));
    assert.deepEqual([...new Set(heights)], [1]);
    await page.locator('#input [role=option]').first().click();
    const {row, line} = await page.evaluate(() => {
      const row = document.querySelector('#input [role=option]'), range = document.createRange();
      range.selectNodeContents(row);
      return {row: row.getBoundingClientRect().right, line: range.getBoundingClientRect().right};
    });
    assert.ok(row >= line, `the row ends at ${row}, its text at ${line}`);
    await page.selectOption('[name=dialect]', '');
  },

  async 'tools have names and edges'(page) {
    const path = file('named.mpf', ['G17 G90 G40 G0 X-20 Y-20', 'T="ROUGH 10" D2', 'G41 G1 X0 Y0 F500', 'Y50', 'X50', 'Y0', 'X0', 'G40 X-20 Y-20', 'M30', ''].join('\n'));
    await page.selectOption('[name=dialect]', 'sinumerik');
    await show(page, path, {tool_radius: '', tools: '7"ROUGH 10"/2:5'});
    assert.match(await page.textContent('#certificate'), /needed 5 mm/);
    await page.fill('[name=tools]', '7"ROUGH 10:5');
    await page.click('#compute');
    await page.waitForFunction(() => /Tool table: “7"ROUGH 10:5” is not possible/.test(document.getElementById('state').textContent));
    await page.fill('[name=tools]', '');
    await page.selectOption('[name=dialect]', '');
  },

  async 'what it shows is what the command line says'(page) {
    const path = join(top, 'client/samples/bracket.nc');
    await show(page, path, {tool_radius: ''});
    const said = trc('verify', path).stdout;
    const [, distance] = /smallest clearance ([\d.]+) mm/.exec(said);
    const certificate = await page.textContent('#certificate');
    assert.ok(Math.abs(Number(/smallest distance\s*([\d.]+)/.exec(certificate)[1]) - Number(distance)) < 1e-3, certificate + said);
    const [, touched] = /touches ([\d.]+ %)/.exec(said);
    assert.ok(certificate.includes(`wall touched${touched}`), certificate + said);
    const expected = trc('compensate', path).stdout.split('\n')[0];
    await page.waitForFunction(() => document.querySelectorAll('#output [role=option]').length > 0);
    assert.ok((await page.locator('#output [role=option]').first().textContent()).endsWith(expected));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-nc')]);
    assert.equal(readFileSync(await download.path(), 'utf8'), trc('compensate', path).stdout);
    const [svg] = await Promise.all([page.waitForEvent('download'), page.click('#save-svg')]);
    assert.match(readFileSync(await svg.path(), 'utf8'), /^<\?xml[^]*<path d="M[^]*>20<\/text>[^]*>X \/ mm<\/text>/);
  },

  async 'a distance of 0 is one'(page) {
    await show(page, file('through.nc', through));
    await page.waitForFunction(() => /smallest distance0 mm, needed 5 mm/.test(document.getElementById('certificate').textContent));
    assert.match(await page.textContent('#certificate'), /too near\s*1/);
  },

  async 'a dropped file, a click on the path, the tool on its way, a second radius'(page) {
    await page.fill('[name=tool_radius]', '5');
    await page.evaluate(text => {
      const data = new DataTransfer();
      data.items.add(new File([text], 'dropped.nc'));
      dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true}));
    }, notch.replace(/N40[^]*N70/, 'N70'));
    await page.waitForSelector('body[data-view]');
    await page.waitForSelector('body[data-complete=true]');
    assert.match(await page.textContent('#programs'), /dropped\.nc/);
    // In the middle lies the straight piece of N70, line 4.
    const box = await page.locator('#over').boundingBox();
    let picked = null;
    for (let y = 0.1; y < 0.95 && picked !== '4'; y += 0.01) {
      await page.mouse.click(box.x + box.width / 2, box.y + box.height * y);
      picked = await page.evaluate(() => document.querySelector('#input [aria-selected=true] .number')?.textContent);
    }
    assert.equal(picked, '4');
    await page.locator('#way').focus();
    await page.keyboard.press('End');
    await page.waitForFunction(() => document.getElementById('place').textContent.startsWith('X80 Y-20'));
    await page.fill('#compare-value', '3');
    await page.click('#compare-form button[type=submit]');
    await page.waitForSelector('body[data-compared]');
    assert.match(await page.textContent('#compared'), /^Tool radius 3 mm: path length in the plane 126\.4726 mm; smallest distance 3 mm, needed 3 mm$/);
    // Another option, whose values are offered; it stays when the program is computed again.
    await page.selectOption('#compare-setting', 'transition');
    const [before, offered] = await page.evaluate(() => [document.body.dataset.compared,
      [...document.querySelectorAll('#compare-value option')].map(option => option.value)]);
    assert.ok(offered.length > 2, String(offered));
    await page.selectOption('#compare-value', offered.at(-1));
    await page.click('#compare-form button[type=submit]');
    await page.waitForFunction(old => document.body.dataset.compared !== old, before);
    assert.match(await page.textContent('#compared'), /^Outside corners /);
    await page.click('#compute');
    await page.waitForFunction(() => /^Outside corners /.test(document.getElementById('compared').textContent));
    await page.check('#layers label:has([data-text=layerBand]) input');
    await page.selectOption('#language', 'de');
    assert.equal(await page.textContent('#compute'), 'Korrigieren');
    assert.equal(await page.getAttribute('html', 'lang'), 'de');
  },

  async 'what is dropped and no file leaves all as it is'(page) {
    await show(page, join(top, 'client/samples/bracket.nc'), {tool_radius: ''});
    const before = await page.evaluate(() => document.body.dataset.view);
    await page.evaluate(() => {
      const data = new DataTransfer();
      data.setData('text/plain', 'G41');
      dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true}));
      document.getElementById('file').dispatchEvent(new Event('change'));
    });
    await page.locator('#way').fill('5000');
    await page.waitForFunction(() => /line/.test(document.getElementById('place').textContent));
    assert.equal(await page.evaluate(() => document.body.dataset.view), before);
  },

  async 'a file that has changed since it was opened is not taken for a lost server'(page) {
    const bracket = readFileSync(join(top, 'client/samples/bracket.nc'), 'utf8');
    for (const button of ['#save-nc', '#save-record', '#survey']) {
      const path = file('changing.nc', bracket);
      await show(page, path, {tool_radius: ''});
      writeFileSync(path, `${bracket}(more)\n`);
      await page.click(button);
      await page.waitForFunction(() => document.getElementById('state').className === 'error');
      assert.equal(await page.textContent('#state'), 'the file has changed or cannot be read: open it again');
    }
    page.problems = page.problems.filter(problem => !/ERR_UPLOAD_FILE_CHANGED/.test(problem));
  },

  async 'several programs at once, of which each is shown'(page) {
    await page.evaluate(texts => {
      const data = new DataTransfer();
      for (const [i, text] of texts.entries()) data.items.add(new File([text], `part${i}.nc`));
      data.items.add(new File(['M30'], `${'long'.repeat(60)}.nc`));
      dispatchEvent(new DragEvent('drop', {dataTransfer: data, bubbles: true, cancelable: true}));
    }, [notch, readFileSync(join(top, 'client/samples/bracket.nc'), 'utf8')]);
    await page.waitForSelector('body[data-view]');
    assert.deepEqual((await page.locator('#programs option').allTextContents()).slice(0, 2), ['part0.nc', 'part1.nc']);
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out');
    assert.match(await page.textContent('#state'), /Refused/);
    await page.selectOption('#programs', '1');
    await page.waitForFunction(() => /nothing to complain/.test(document.getElementById('state').textContent));
    assert.match(await page.textContent('#certificate'), /tool radius6 mm/);
  },

  async 'arrows say which way it goes, along one line and along short ones'(page) {
    const arrows = () => page.evaluate(() => Number(document.body.dataset.arrows));
    const circle = Array.from({length: 1000}, (_, i) => `G01 X${(50 * Math.cos(i * Math.PI / 500)).toFixed(4)} Y${(50 * Math.sin(i * Math.PI / 500)).toFixed(4)}`);
    await show(page, file('round.nc', ['G00 X60 Y-20', 'G41 G01 X50 Y0 F500', ...circle.slice(1), 'G01 X50 Y0', 'G40 G01 X60 Y20', 'M30', ''].join('\n')));
    assert.ok(await arrows() > 10, `${await arrows()} arrows`);
    await show(page, file('notch.nc', notch));
    assert.ok(await arrows() > 2);
    await page.uncheck('#layers label:has([data-text=layerArrows]) input');
    await page.waitForFunction(() => document.body.dataset.arrows === '0');
  },

  async 'lengths are said as the program counts them'(page) {
    const path = file('inch.nc', 'O1\nG20 G17 G90\nG00 X-1. Y-1. Z.2\nG41 D1 G01 X0. Y0. F20.\nY2.\nX4.\nY0.\nX0.\nG40 X-1. Y-1.\nM30\n');
    await page.selectOption('[name=dialect]', 'fanuc');
    await show(page, path, {tool_radius: '6.35'});
    assert.match(await page.textContent('#certificate'), /smallest distance0\.25 inch, needed 0\.25 inch.*tool radius0\.25 inch/);
    await page.locator('#way').focus();
    await page.keyboard.press('End');
    await page.waitForFunction(() => document.getElementById('place').textContent.startsWith('X-1 Y-1 Z0.2'));
    const box = await page.locator('#over').boundingBox();
    const cursor = async x => {
      await page.mouse.move(box.x + x, box.y + box.height / 2);
      return page.textContent('#cursor');
    };
    assert.match(await cursor(50), /^X -?\d\.\d{4} {2}Y -?\d\.\d{4} inch$/);
    // From side to side the distance is some inches; by keys, from a point to itself, it is none.
    await page.click('#measure');
    await page.mouse.click(box.x + 5, box.y + 5);
    await page.mouse.click(box.x + box.width - 5, box.y + 5);
    const [, across] = /^([\d.]+) inch \(X /.exec(await page.textContent('#place'));
    const xOf = text => Number(/X (-?[\d.]+)/.exec(text)[1]);
    const ends = [xOf(await cursor(5)), xOf(await cursor(box.width - 5))];
    assert.ok(Math.abs(Number(across) - (ends[1] - ends[0])) < 1e-3, `${across} ${ends}`);
    await page.locator('#over').focus();
    await page.keyboard.press('Enter');
    await page.keyboard.press('Enter');
    assert.match(await page.textContent('#place'), /^0 inch/);
  },

  async 'other planes and heights have their view'(page) {
    const ramp = 'N10 G17 G90 G71\nN20 G00 X-20 Y-20 Z10\nN30 G01 Z0 F200\nN40 G41 G01 X0 Y0 F500\nN50 Y60 Z-2\nN60 X80 Z-4\n' +
      'N70 G02 X100 Y40 I0 J-20 Z-6\nN80 G01 Y0 Z-8\nN90 X0 Z-10\nN100 G40 X-20 Y-20\nN110 G00 Z10\nN120 M30\n';
    const path = file('ramp.nc', ramp), written = join(folder, 'ramp.html');
    const look = async () => {
      assert.equal(await page.inputValue('#plane'), 'PLANE_XY');
      assert.match(await page.textContent('#certificate'), /planeXY.*heightZ -10 … 10 mm/);
      await page.selectOption('#plane', 'PLANE_YZ');
      await page.waitForFunction(() => /planeYZ/.test(document.getElementById('certificate').textContent));
      await page.waitForSelector('body[data-complete=true]');
      assert.ok(Number(await page.evaluate(() => document.body.dataset.segments)) > 20);
      assert.match(await page.textContent('#certificate'), /path length in XY417\.5542 mm, 10 blocks.*heightX -20 … 105 mm/);
      // Upwards lies Z.
      const box = await page.locator('#over').boundingBox();
      const cursor = async y => {
        await page.mouse.move(box.x + box.width / 2, box.y + y);
        return Number(/^Y .* Z (-?[\d.]+) mm$/.exec(await page.textContent('#cursor'))[1]);
      };
      assert.ok(await cursor(20) > await cursor(box.height - 20));
      await page.locator('#way').fill('5000');
      await page.waitForFunction(() => /^X.*line/.test(document.getElementById('place').textContent));
      const at = await page.textContent('#place');
      // Seen from above the place is the same one, and the texts on both sides are linked.
      await page.waitForFunction(() => document.querySelectorAll('#output [role=option]').length > 0);
      await page.locator('#output [role=option]').filter({hasText: 'N80'}).click();
      await page.waitForFunction(() => /N80/.test(document.querySelector('#input [aria-selected=true]')?.textContent));
      await page.selectOption('#plane', 'PLANE_XY');
      await page.waitForFunction(() => /planeXY/.test(document.getElementById('certificate').textContent));
      await page.locator('#way').fill('5000');
      await page.waitForFunction(() => /^X.*line/.test(document.getElementById('place').textContent));
      const numbers = text => text.match(/-?[\d.]+/g).map(Number);
      numbers(await page.textContent('#place')).forEach((n, i) => assert.ok(Math.abs(n - numbers(at)[i]) < 0.05, `${at}`));
    };
    await show(page, path);
    await look();
    trc('plot', path, '-o', written, '--radius', '5');
    await page.goto(`file://${written}`);
    await page.waitForSelector('body[data-complete=true]');
    await look();
  },

  async 'the record of a page is one for trc verify'(page) {
    const path = join(top, 'client/samples/bracket.nc');
    await show(page, path, {tool_radius: ''});
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-record')]);
    assert.equal(download.suggestedFilename(), 'bracket_g40.json');
    const told = trc('verify', path, '--record', await download.path());
    assert.equal(told.status, 0, told.stderr);
    assert.match(told.stdout, /the record holds/);
    await show(page, file('notch.nc', notch));
    assert.ok(await page.locator('#save-record').isDisabled());
  },

  async 'a wrong setting is said where it is'(page) {
    await page.fill('[name=tool_radius]', 'five');
    await page.setInputFiles('#file', file('square.nc', notch));
    await page.waitForFunction(() => document.getElementById('state').classList.contains('error'));
    assert.match(await page.textContent('#state'), /^Tool radius, mm: “five” is not possible; it takes: -214748\.3647 … 214748\.3647$/);
    assert.ok(await page.evaluate(() => !document.querySelector('[name=tool_radius]').validity.valid));
  },

  async 'a refused approach comes with what would do'(page) {
    const path = join(top, 'tests/programs/bad/d03_selection_block_too_short.nc');
    await show(page, path, {tool_radius: ''});
    const said = trc('plot', path, '-o', join(folder, 'd03.svg')).stderr;
    const list = page.locator('#diagnostics .proposals');
    assert.match(await list.textContent(), /5 mm long, needs at least 10 mm; may start at X-5 Y0/);
    assert.match(said, /5\.000 mm long and needs at least 10\.000 mm; it may start at X-5 Y0/);
    assert.match(await list.locator('button').first().textContent(), /Proposed entry, line X-5 Y0 → X5 Y0/);
    const arc = await list.locator('button').nth(1).textContent();
    assert.match(arc, /quarter circle .* → arc R20 X5 Y0/);
    // Green, and dashed: some of what lies along the line is drawn.
    await list.locator('button').first().click();
    await page.waitForSelector('body[data-complete=true]');
    const green = () => page.evaluate(() => {
      const canvas = document.getElementById('over'), pixels = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data;
      let count = 0;
      for (let i = 0; i < pixels.length; i += 4)
        if (pixels[i] === 0x13 && pixels[i + 1] === 0x8a && pixels[i + 2] === 0x36) ++count;
      return count;
    });
    assert.ok(await green() > 100, 'proposals are drawn');
    await page.uncheck('#layers label:has([data-text=layerProposal]) input');
    await page.waitForSelector('body[data-complete=true]');
    assert.equal(await green(), 0);
  },

  async 'it says which tool fits'(page) {
    const path = join(top, 'client/samples/bracket.nc');
    await show(page, path, {tool_radius: ''});
    await page.click('#survey');
    await page.waitForSelector('#largest button');
    const told = JSON.parse(trc('radii', path, '--radii', '6', '--json').stdout);
    assert.match(await page.textContent('#largest'), new RegExp(`every wall: ${told.summary.largest.radius} mm`));
    const lines = told.summary.largest.limits.map(limit => `line ${limit.line}`);
    assert.deepEqual(await page.locator('#largest button').allTextContents(), lines);
    const uncut = Number(/([\d.]+) mm of [\d.]+ mm stay uncut with 6 mm/.exec(await page.textContent('#largest p'))[1]);
    assert.ok(Math.abs(uncut - (told.radii[0].uncutLength ?? 0)) < 1e-3);
    await page.locator('#largest button').first().click();
    assert.equal(`line ${await page.locator('#input [aria-selected=true] .number').textContent()}`, lines[0]);
  },

  async 'settings are called and explained as the server has them, in German too'(page) {
    const found = await page.evaluate(async () => {
      const {words} = await import('/page/texts.js');
      const {hasName, settingMeaning, settingName, settingWord} = await import('/page/settings_texts.js');
      const {notForPeople} = await import('/page/options.js');
      const parameters = (await (await fetch('v1/openapi.json')).json()).paths['/v1/views'].post.parameters
        .filter(p => p.in === 'query' && !notForPeople.includes(p.name));
      const digits = text => (text.match(/[0-9.]*[0-9]/g) ?? []).sort().join(' ');
      const meaning = p => settingMeaning(p['x-meaning'], 'de');
      // A label says neither unit nor range: these come from the server.
      const names = parameters.flatMap(p => ['en', 'de'].map(language => settingName(p.name, language)));
      return {
        missing: Object.keys(words.en).filter(key => !(key in words.de)).concat(Object.keys(words.de).filter(key => !(key in words.en))),
        unused: Object.keys(words.en).filter(key => words.en[key] === ''),
        unnamed: parameters.map(p => p.name).filter(name => !hasName(name)),
        saidTwice: names.filter(name => /\bmm\b|degrees|Grad\b|\b[0-9]+\b/.test(name)),
        withoutMeaning: parameters.filter(p => !p['x-meaning']).map(p => p.name),
        unmeant: parameters.filter(p => meaning(p) === p['x-meaning']).map(p => p.name),
        otherNumbers: parameters.filter(p => digits(meaning(p)) !== digits(p['x-meaning'])).map(p => p.name),
        asTheyAre: parameters.flatMap(p => p.schema.enum ? p['x-values'].split(', ') : []).filter(word => settingWord(word, 'de') === word),
        unsaid: parameters.map(p => p['x-values']).filter(text => / /.test(text) && !/, |in mm/.test(text) && text !== 'true or false' && settingWord(text, 'de') === text),
      };
    });
    assert.deepEqual(found, {missing: [], unused: [], unnamed: [], saidTwice: [], withoutMeaning: [], unmeant: [], otherNumbers: [], asTheyAre: ['xy (G17)', 'zx (G18)', 'yz (G19)', 'linear (G25)', 'linear (0)', 'utf8', 'latin1', 'mm'], unsaid: []});
    const axis = page.locator('#more-settings label', {has: page.locator('[name="options.split.axis"]')});
    const tools = page.locator('#main-settings label', {has: page.locator('[name=tools]')});
    assert.match(await tools.textContent(), /the tools of D words.*as in 1:5,2:3\.5/);
    assert.match(await axis.textContent(), /#TRC SPLIT: axis.*the axis, 1 for X, 2 for Y, 3 for Z; 1 … 3/);
    await page.selectOption('#language', 'de');
    assert.match(await page.textContent('#main-settings'), /Werkzeugradius, mm.*Dialekt.*nicht gesetzt.*sonst ISG/s);
    assert.match(await page.textContent('#more-settings'), /Konturschleifen werden entfernt/);
    const left = await page.evaluate(() => [...document.querySelectorAll('[data-text], [data-label]')]
      .filter(e => (e.dataset.text && e.textContent === e.dataset.text) || (e.dataset.label && e.getAttribute('aria-label') === e.dataset.label))
      .map(e => e.outerHTML));
    assert.deepEqual(left, []);
  },

  async 'what a setting means is said without hiding another one'(page) {
    for (const name of ['tool_radius', 'dialect', 'tools', 'contour_masking']) {
      await page.locator(`[name="${name}"]`).focus();
      const found = await page.evaluate(name => {
        const inputs = [...document.querySelectorAll('#main-settings :is(input, select)')];
        const covered = inputs.filter(input => {
          const {left, top, width, height} = input.getBoundingClientRect();
          return document.elementFromPoint(left + width / 2, top + height / 2) !== input;
        });
        const about = document.getElementById('about');
        return {covered: covered.map(input => input.name), cut: about.scrollHeight - about.clientHeight,
          said: about.textContent === `${document.querySelector(`[name="${name}"]`).parentNode.firstChild.textContent}: ${document.querySelector(`[name="${name}"]`).parentNode.querySelector('small').textContent}`};
      }, name);
      assert.deepEqual(found, {covered: [], cut: 0, said: true}, name);
    }
  },

  async 'a program that is refused while it is read shows what was read'(page) {
    await show(page, file('read.nc', notch.replace('N80 G40 G01', 'N80 G777 G01')), {tool_radius: '1'});
    assert.match(await page.textContent('#state'), /Refused/);
    assert.equal(await page.locator('#diagnostics button.error').getAttribute('data-code'), '900002');
    // The notch with its walls, and the path beside the first of them.
    assert.ok(Number(await page.evaluate(() => document.body.dataset.segments)) >= 10);
    assert.match(await page.textContent('#certificate'), /path length.* 5 blocks/);
  },

  async 'each tool sweeps its own band, also where its path is out of sight'(page) {
    // Two squares of 50 mm beside each other, the left one with 6 mm, the right one with 3 mm.
    const square = (d, x) => `G00 X${x - 20} Y-20\nG41 D${d} G01 X${x} Y0 F500\nY50\nX${x + 50}\nY0\nX${x}\nG40 X${x - 20} Y-20\n`;
    await show(page, file('two.nc', square(1, 0) + square(2, 100) + 'M30\n'), {tools: '1:6,2:3', tool_radius: ''});
    assert.match(await page.textContent('#certificate'), /tool radius3, 6 mm/);
    await page.check('#layers label:has([data-text=layerBand]) input');
    await page.waitForSelector('body[data-complete=true]');
    // Above each square: 10 mm are within twice 6 mm, and not within twice 3 mm.
    assert.deepEqual([await colourAt(page, 25, 60), await colourAt(page, 125, 60), await colourAt(page, 125, 54)], [sweptColour, emptyColour, sweptColour]);
    // Half a millimetre of the wall is seen, the path 6 mm beside it is not.
    await page.evaluate(async () => {
      const {camera, redraw} = await import('/page/picture.js');
      camera.show({x: 24.75, y: 49.75}, {x: 25.25, y: 50.25});
      redraw();
    });
    await page.waitForSelector('body[data-complete=true]');
    assert.deepEqual([await colourAt(page, 25.1, 50.1), await colourAt(page, 25.1, 49.9)], [sweptColour, emptyColour]);
  },

  async 'an arc is round, on its own and as a part of what the tool sweeps'(page) {
    // A hole of 40 mm, with a path of 30 mm in diameter.
    const path = file('hole.nc', 'G0 X0 Y0\nG41 G1 X10 Y-10 F600\nG3 X20 Y0 I0 J10\nG3 I-20 J0\nG3 X10 Y10 I-10 J0\nG40 G1 X0 Y0\nM30\n');
    const written = join(folder, 'hole.html');
    await show(page, path);
    await page.uncheck('#layers label:has([data-text=layerArrows]) input');
    await page.check('#layers label:has([data-text=layerBand]) input');
    await page.waitForSelector('body[data-complete=true]');
    for (const angle of [1.2, 2, 2.6, 3.5, 4.4, 5]) {
      const at = radius => colourAt(page, radius * Math.cos(angle), radius * Math.sin(angle));
      assert.deepEqual([await at(15), await at(17.5), await at(20.7)], ['#0072b2', sweptColour, emptyColour], `${angle}`);
      // The contour is hardly wider than a pixel.
      assert.match(await at(20), /^#[0-9]/, `${angle}`);
    }
    // Saved it is one too, also where no server draws it.
    const saved = async () => {
      const [svg] = await Promise.all([page.waitForEvent('download'), page.click('#save-svg')]);
      return readFileSync(await svg.path(), 'utf8').match(/A([\d.]+) \1 0 0 [01] /g).length;
    };
    assert.ok(await saved() > 10);
    trc('plot', path, '-o', written, '--radius', '5');
    await page.goto(`file://${written}`);
    await page.waitForSelector('body[data-complete=true]');
    assert.ok(await saved() > 10);
  },

  async 'a graphics processor that comes back draws all again'(page) {
    await show(page, file('square.nc', notch.replace(/N40[^]*N70/, 'N70')));
    await page.uncheck('#layers label:has([data-text=layerArrows]) input');
    await page.waitForSelector('body[data-complete=true]');
    assert.equal(await colourAt(page, 30, -5), '#0072b2');
    await page.evaluate(async () => {
      const lose = document.getElementById('lines').getContext('webgl2').getExtension('WEBGL_lose_context');
      const once = name => new Promise(resolve => document.getElementById('lines').addEventListener(name, resolve, {once: true}));
      const lost = once('webglcontextlost');
      lose.loseContext();
      await lost;
      await new Promise(resolve => setTimeout(resolve));
      const restored = once('webglcontextrestored');
      lose.restoreContext();
      await restored;
    });
    await page.waitForSelector('body[data-complete=true]');
    assert.equal(await colourAt(page, 30, -5), '#0072b2');
  },

  async 'a result stands only for the settings it was made with'(page) {
    const path = file('square.nc', notch.replace(/N40[^]*N70/, 'N70'));
    await show(page, path);
    assert.match(await page.textContent('#state'), /nothing to complain about/);
    await page.fill('[name=tool_radius]', '4');
    assert.match(await page.textContent('#state'), /settings have changed/);
    await page.fill('[name=tool_radius]', '5');
    assert.match(await page.textContent('#state'), /nothing to complain about/);
    // An answer that comes late is not the answer to what was asked last.
    let held = null;
    await page.route(/v1\/views\?.*tool_radius=2&/, route => { held = route; });
    await page.fill('[name=tool_radius]', '2');
    await page.click('#compute');
    await page.fill('[name=tool_radius]', '3');
    await page.click('#compute');
    await page.waitForFunction(() => /tool radius3 mm/.test(document.getElementById('certificate').textContent));
    await held.continue().catch(() => {});
    await page.waitForTimeout(300);
    assert.match(await page.textContent('#certificate'), /tool radius3 mm/);
    // Of a program that cannot be asked for nothing is shown, least of all what was there before.
    await page.fill('[name=tool_radius]', 'five');
    await page.setInputFiles('#file', file('other.nc', notch));
    await page.waitForFunction(() => document.getElementById('state').classList.contains('error'));
    assert.equal(await page.textContent('#certificate') + await page.textContent('#input'), '');
    assert.ok(await page.locator('#save-nc').isDisabled() && await page.locator('#save-svg').isDisabled());
  },

  async 'what must not be machined is said first'(page) {
    // A neck of 6 mm that is wider inside: nothing runs backwards, but the tool of 5 mm cuts both walls.
    await show(page, join(top, 'tests/programs/good/t17_bottleneck_not_seen.nc'), {tool_radius: ''});
    assert.match(await page.textContent('#state'), /Do not machine this/);
    assert.ok(await page.evaluate(() => document.getElementById('state').classList.contains('error')));
    await show(page, file('rapids.nc', 'N10 G00 X10 Y10\nN20 G00 X50\nN30 M30\n'));
    assert.match(await page.textContent('#state'), /Nothing is compensated/);
    await show(page, file('rapid.nc', 'N10 G00 X10 Y10\nN20 M30\n'));
    assert.match(await page.textContent('#certificate'), /, 1 blockheight/);
  },

  async 'a radius of the program is said where another one was asked for'(page) {
    const path = join(top, 'client/samples/bracket.nc');
    await show(page, path, {tool_radius: '3'});
    assert.match(await page.textContent('#certificate'), /the program has its own radius: 6 mm/);
    await show(page, path, {tool_radius: ''});
    assert.doesNotMatch(await page.textContent('#certificate'), /own radius/);
    // Compared it is another radius all the same: so much less of the own one, or of the only tool.
    const compare = async (setting, value) => {
      await page.selectOption('#compare-setting', setting);
      await page.fill('#compare-value', value);
      await page.evaluate(() => { delete document.body.dataset.compared; });
      await page.click('#compare-form button[type=submit]');
      await page.waitForSelector('body[data-compared]');
      return page.textContent('#compared');
    };
    assert.match(await compare('tool_radius', '3'), /^Tool radius 3 mm: .*smallest distance 3 mm, needed 3 mm$/);
    assert.match(await compare('closing_tolerance', '0.02'), /no difference$/);
    await show(page, file('table.nc', 'G00 X-20 Y-20\nG41 D7 G01 X0 Y0 F500\nY50\nX50\nY0\nX0\nG40 X-20 Y-20\nM30\n'), {tools: '7:6'});
    assert.match(await compare('tool_radius', '4'), /smallest distance 4 mm, needed 4 mm$/);
    assert.match(await compare('wear', '-0.5'), /no difference$/);
  },

  async 'the tool runs along its path by itself'(page) {
    await show(page, join(top, 'client/samples/bracket.nc'), {tool_radius: ''});
    const way = () => page.locator('#way').evaluate(input => Number(input.value));
    const says = async (en, de) => {
      assert.equal(await page.textContent('#play'), en);
      await page.selectOption('#language', 'de');
      assert.equal(await page.textContent('#play'), de);
      await page.selectOption('#language', 'en');
      await page.waitForSelector('body[data-complete=true]');
    };
    await says('Run', 'Abfahren');
    await page.click('#play');
    await page.waitForFunction(() => /line/.test(document.getElementById('place').textContent) && document.getElementById('way').value > 50);
    assert.equal(await page.textContent('#play'), 'Stop');
    assert.match(await page.getAttribute('#way', 'aria-valuetext'), /^X.* line \d+$/);
    await page.click('#play');
    const stopped = await way();
    await page.waitForTimeout(200);
    assert.equal(await way(), stopped);
    await says('Run', 'Abfahren');
    // At its end it stands there.
    await page.locator('#way').fill('9990');
    await page.click('#play');
    await page.waitForFunction(() => document.getElementById('play').textContent === 'Run');
    assert.equal(await way(), 10_000);
    assert.match(await page.textContent('#place'), /^X-25 Y-10/);
  },

  async 'trc view opens a program with its dialect and tools'(page) {
    const tools = file('tools.csv', 'number,radius,wear\n1,6.35,-0.02\n');
    const path = file('view.nc', 'O1\nG20 G17 G90\nG00 X-1. Y-1. Z.2\nG41 D1 G01 X0. Y0. F20.\nY2.\nX4.\nY0.\nX0.\nG40 X-1. Y-1.\nM30\n');
    const view = spawn(`${build}/bin/trc`, ['view', path, '--no-browser', '--dialect', 'fanuc', '--tools', tools,
      '--set', 'stretch_factor=2', '--lang', 'de'], {stdio: ['ignore', 'pipe', 'inherit']});
    try {
      const address = await new Promise(resolve => view.stdout.once('data', data => resolve(String(data).trim())));
      page.own = new URL(address).host;
      await page.goto(address);
      await page.waitForSelector('body[data-complete=true]');
      assert.equal(await page.inputValue('#language'), 'de');
      assert.equal(await page.inputValue('[name=dialect]'), 'fanuc');
      assert.equal(await page.inputValue('[name=tools]'), '1:6.35:-0.02');
      assert.match(await page.textContent('#certificate'), /Werkzeugradius0\.24921 inch/);
      assert.match(page.url(), /offer=/);
    } finally { view.kill(); }
  },

  async 'a page with its program inside needs no server'(page) {
    for (const [name, text] of [['notch.nc', notch], ['bracket.nc', readFileSync(join(top, 'client/samples/bracket.nc'), 'utf8')]]) {
      const path = file(name, text), written = join(folder, `${name}.html`);
      const said = trc('plot', path, '-o', written, ...(name === 'notch.nc' ? ['--radius', '5'] : [])).stderr;
      const asked = [];
      page.on('request', request => asked.push(request.url()));
      await page.goto(`file://${written}`);
      await page.waitForSelector('body[data-complete=true]');
      assert.deepEqual(asked.filter(url => !/^(file|data|blob):/.test(url)), []);
      assert.equal(await page.title(), name);
      assert.ok(Number(await page.evaluate(() => document.body.dataset.segments)) > 10);
      assert.ok(Number(await page.evaluate(() => document.body.dataset.arrows)) > 2, 'its arrows too');
      assert.match(readFileSync(written, 'utf8'), /"contourBlocks":"\d+"/, 'and its contour');
      assert.ok(!await page.locator('#form').isVisible(), 'nothing can be computed here');
      await page.evaluate(() => {
        for (const kind of ['dragover', 'drop']) dispatchEvent(new DragEvent(kind, {bubbles: true, cancelable: true}));
      });
      assert.equal(await page.getAttribute('#stage', 'class') || '', '', 'what is dropped here is left alone');
      if (name === 'notch.nc') {
        const [, line, code] = /notch\.nc:(\d+):.* error (\d+)/.exec(said);
        const button = page.locator('#diagnostics button.error').first();
        assert.equal(await button.getAttribute('data-code'), code);
        await button.click();
        assert.equal(await page.locator('#input [aria-selected=true] .number').textContent(), line);
        continue;
      }
      // Text, clearance, the way of the tool and both listings are those of a server's page.
      const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-nc')]);
      assert.equal(readFileSync(await download.path(), 'utf8'), trc('compensate', path).stdout);
      assert.match(await page.textContent('#certificate'), /smallest distance6 mm, needed 6 mm/);
      await page.locator('#output [role=option]').filter({hasText: 'N70'}).click();
      assert.match(await page.locator('#input [aria-selected=true]').textContent(), /N70/);
      await page.locator('#way').focus();
      await page.keyboard.press('End');
      await page.waitForFunction(() => document.getElementById('place').textContent.startsWith('X-25 Y-10'));
      // What it may do is what its policy says: no script of somebody else's runs in it.
      await page.evaluate(() => {
        const script = document.createElement('script');
        script.textContent = 'document.body.dataset.foreign = 1';
        document.body.append(script);
      });
      assert.equal(await page.evaluate(() => document.body.dataset.foreign), undefined);
      page.problems = page.problems.filter(problem => !/Content Security Policy/.test(problem));
    }
    // Messages stay in their language, and the page speaks it.
    trc('plot', file('notch.nc', notch), '-o', join(folder, 'german.html'), '--radius', '5', '--lang', 'de');
    await page.goto(`file://${join(folder, 'german.html')}`);
    await page.waitForSelector('body[data-complete=true]');
    assert.equal(await page.inputValue('#language'), 'de');
    assert.match(await page.textContent('#state'), /^Abgelehnt/);
    // Letters of Latin-1 are read as such, and come out in the bytes they came in.
    const latin = Buffer.from('O1 (FR\u00c4SEN)\nG0 X0 Y0\nG41 D1 G1 X10. Y0 F100.\nX40.\nG40 Y20.\nM30\n', 'latin1');
    const path = file('latin.nc', latin), written = join(folder, 'latin.html');
    trc('plot', path, '-o', written, '--radius', '5', '--dialect', 'fanuc');
    await page.goto(`file://${written}`);
    await page.waitForSelector('body[data-complete=true]');
    await page.waitForFunction(() => /O1 \(FR\u00c4SEN\)/.test(document.getElementById('input').textContent));
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#save-nc')]);
    assert.ok(readFileSync(await download.path()).includes(latin.subarray(0, 11)));
  },

  async 'fingers and keys do what the mouse does'(page) {
    await show(page, file('notch.nc', notch));
    const shown = () => page.evaluate(() => document.getElementById('cursor').textContent);
    const box = await page.locator('#over').boundingBox();
    const at = [box.x + box.width / 2, box.y + box.height / 2];
    const where = async () => {
      await page.mouse.move(at[0], at[1]);
      await page.mouse.move(at[0] + 100, at[1]);
      return shown();
    };
    const before = await where();
    await page.locator('#over').focus();
    await page.keyboard.press('+');
    const closer = await where();
    assert.notEqual(closer, before);
    await page.keyboard.press('ArrowRight');
    assert.notEqual(await where(), closer);
    await page.keyboard.press('0');
    assert.equal(await where(), before);
    // Two fingers apart: twice as near, about the one that stays.
    await page.evaluate(() => {
      const stage = document.getElementById('over');
      stage.setPointerCapture = () => {};
      const {left, top, width, height} = stage.getBoundingClientRect();
      const x = left + width / 2, y = top + height / 2;
      const send = (type, id, dx) => stage.dispatchEvent(new PointerEvent(type, {pointerId: id, pointerType: 'touch', clientX: x + dx, clientY: y, bubbles: true}));
      send('pointerdown', 1, 0);
      send('pointerdown', 2, 100);
      send('pointermove', 2, 200);
      send('pointerup', 2, 200);
      send('pointerup', 1, 0);
    });
    const xOf = text => Number(/X (-?[\d.]+)/.exec(text)[1]);
    const near = await where();
    await page.keyboard.press('0');
    await page.mouse.move(at[0], at[1]);
    const middle = xOf(await shown());
    assert.ok(Math.abs((xOf(near) - middle) - (xOf(before) - middle) / 2) < 0.01, `${near} ${before}`);
    // Through the findings and the lines without a mouse.
    await page.locator('#diagnostics button').first().focus();
    await page.keyboard.press('Enter');
    await page.locator('#input [aria-selected=true]').waitFor();
    const number = () => page.locator('#input [aria-selected=true] .number').textContent();
    const first = Number(await number());
    await page.locator('#input').focus();
    await page.keyboard.press('ArrowDown');
    await page.waitForFunction(n => document.querySelector('#input [aria-selected=true] .number')?.textContent === String(n), first + 1);
    // To the ends of both texts, whatever the last rows stem from.
    await show(page, join(top, 'client/samples/bracket.nc'), {tool_radius: ''});
    await page.waitForFunction(() => document.querySelectorAll('#output [role=option]').length > 0);
    const marked = async (text, row) => page.waitForFunction(([id, n]) =>
      document.querySelector(`#${id} [aria-selected=true] .number`)?.textContent === n, [text, String(row)]);
    for (const [text, last, before] of [['input', 21, 20], ['output', 22, 21]]) {
      await page.locator(`#${text}`).focus();
      await page.keyboard.press('End');
      await marked(text, last);
      await page.keyboard.press('PageDown');
      await page.keyboard.press('ArrowUp');
      await page.waitForFunction(([id, n]) => Number(document.querySelector(`#${id} [aria-selected=true] .number`)?.textContent) <= n, [text, before]);
      await page.keyboard.press('Home');
      await page.waitForFunction(id => Number(document.querySelector(`#${id} [aria-selected=true] .number`)?.textContent) < 5, text);
      await page.keyboard.press('PageDown');
      await page.keyboard.press('PageDown');
      await page.keyboard.press('PageDown');
      await marked(text, last);
    }
  },

  async 'a window of another size shows all again, and no more than was seen'(page) {
    await show(page, join(top, 'client/samples/bracket.nc'), {tool_radius: ''});
    const seen = () => page.evaluate(async () => {
      const {camera} = await import('/page/picture.js');
      const [left, bottom] = camera.toScreen({x: -25, y: -20}), [right, above] = camera.toScreen({x: 111, y: 86});
      return {scale: camera.scale, width: camera.width, whole: left > 0 && above > 0 && right < camera.width && bottom < camera.height};
    });
    const resize = async size => {
      const {width} = await seen();
      await page.setViewportSize(size);
      for (let i = 0; i < 200 && (await seen()).width === width; ++i) await page.waitForTimeout(50);
      await page.waitForSelector('body[data-complete=true]');
    };
    await resize({width: 740, height: 360});
    const {scale, whole} = await seen();
    assert.ok(whole);
    await page.click('#zoom-in');
    await resize({width: 1400, height: 900});
    assert.ok(Math.abs((await seen()).scale / scale - 1.4) < 1e-9);
  },

  async 'what reaches farther than what was refused is shown as a whole'(page) {
    const isWhole = () => page.evaluate(async () => {
      const {camera} = await import('/page/picture.js'), {shown} = await import('/page/shown.js');
      const {low, high} = shown.current.view, [left, bottom] = camera.toScreen({x: low.x ?? 0, y: low.y ?? 0});
      const [right, above] = camera.toScreen({x: high.x ?? 0, y: high.y ?? 0});
      const share = Math.max((right - left) / camera.width, (bottom - above) / camera.height);
      return left > 0 && above > 0 && right < camera.width && bottom < camera.height && share > 0.85;
    });
    const compute = async radius => {
      await page.fill('[name=tool_radius]', radius);
      await page.click('#compute');
      await page.waitForFunction(() => document.body.dataset.changed === 'false');
      await page.waitForSelector('body[data-complete=true]');
    };
    // It lacks its radius: nothing of it is seen but the way to where the selection is.
    await show(page, file('far.nc', 'G0 X0 Y0\nG41 G1 X10 Y0 F500\nX400\nY300\nG40 X380 Y320\nM30\n'), {tool_radius: ''});
    assert.match(await page.textContent('#state'), /Refused/);
    await compute('5');
    assert.match(await page.textContent('#state'), /Compensated/);
    assert.ok(await isWhole());
    // Nobody who looks closer is taken away from there.
    await page.click('#zoom-in');
    const seen = () => page.evaluate(async () => ({...(await import('/page/picture.js')).camera}));
    const before = await seen();
    await compute('8');
    assert.deepEqual(await seen(), before);
  },

  async 'on a small screen all of it is there'(page) {
    await page.setViewportSize({width: 360, height: 740});
    await show(page, file('notch.nc', notch));
    for (const part of ['#picture', '#said', '#settings', '#listings']) {
      const {width, height} = await page.locator(part).boundingBox();
      assert.ok(width > 330 && height > 150, `${part} is ${width} by ${height}`);
    }
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), 'nothing sticks out');
    // Nor is there anything below the last part.
    const below = await page.evaluate(() => document.documentElement.scrollHeight - scrollY - document.getElementById('listings').getBoundingClientRect().bottom);
    assert.ok(below < 20, `${below} pixels below the listings`);
    // What a finger is to meet is large enough for it.
    const touched = await open({viewport: {width: 360, height: 740}, hasTouch: true, isMobile: true});
    await show(touched, file('notch.nc', notch));
    const small = await touched.evaluate(() => [...document.querySelectorAll('button, select, summary, label.button, #layers label')]
      .filter(e => e.offsetParent && (e.getBoundingClientRect().width < 40 || e.getBoundingClientRect().height < 36)).map(e => e.outerHTML));
    assert.deepEqual(small, []);
    await touched.context().close();
  },

  async 'everybody can use it'(page) {
    await page.evaluate(source => new Function(source)(), axe).catch(() => page.addScriptTag({content: axe}));
    const check = async state => {
      for (const scheme of ['light', 'dark']) {
        await page.emulateMedia({colorScheme: scheme});
        await page.waitForTimeout(100);
        const found = await page.evaluate(() => globalThis.axe.run(document, {resultTypes: ['violations']}));
        assert.deepEqual(found.violations.map(v => `${state}, ${scheme}: ${v.id}: ${v.nodes[0].html}`), []);
      }
    };
    await check('nothing opened');
    await show(page, join(top, 'tests/programs/bad/d03_selection_block_too_short.nc'), {tool_radius: ''});
    await check('refused with proposals');
    await page.evaluate(() => document.querySelector('details').setAttribute('open', ''));
    await check('all settings');
    // Each is called by its title alone, and what it means is said after that.
    const radius = page.getByRole('textbox', {name: 'Tool radius, mm', exact: true});
    assert.match(await page.textContent(`#${await radius.getAttribute('aria-describedby')}`), /^the size of the tool/);
    const untold = await page.evaluate(() => [...document.querySelectorAll('#form :is(input, select)')]
      .filter(input => !document.getElementById(input.getAttribute('aria-labelledby'))?.textContent || !document.getElementById(input.getAttribute('aria-describedby'))?.textContent)
      .map(input => input.name));
    assert.deepEqual(untold, []);
    await show(page, join(top, 'tests/programs/good/t17_bottleneck_not_seen.nc'));
    await check('too near');
    await show(page, join(top, 'client/samples/bracket.nc'));
    await page.click('#survey');
    await page.waitForSelector('#largest button');
    await page.fill('#compare-value', '3');
    await page.click('#compare-form button[type=submit]');
    await page.waitForSelector('body[data-compared]');
    await page.click('#measure');
    await page.locator('#output [role=option]').first().click();
    await page.selectOption('#language', 'de');
    await check('compared, measured, in German');
    await page.fill('[name=wear]', 'much');
    await check('changed settings');
    await page.click('#compute');
    await page.waitForFunction(() => document.getElementById('state').classList.contains('error'));
    await check('a setting that is refused');
    await page.fill('[name=wear]', '');
    await show(page, file('empty.nc', ''));
    await check('an empty program');
    await page.setViewportSize({width: 360, height: 740});
    await check('a small screen');
  },

  async 'a million blocks stay fluid'(page) {
    const blocks = process.env.TRC_TEST_LONG ? 1_000_000 : 50_000;
    await show(page, file('waves.nc', waves(blocks)), {tool_radius: '0.05'});
    const took = Number(await page.evaluate(() => document.body.dataset.pictureMs));
    assert.ok(Number(await page.evaluate(() => document.body.dataset.segments)) <= 50_000);
    // What is refused once it has come takes as long as the upload.
    const upload = await page.evaluate(async () => {
      const {shown} = await import('/page/shown.js'), began = performance.now();
      await fetch('v1/views?tool_radius=none', {method: 'POST', headers: {'Content-Type': 'text/plain; charset=utf-8'}, body: shown.programs[0].text});
      return performance.now() - began;
    });
    // From the turn of the wheel until all of the picture is drawn at the new scale, and the page is
    // ready for the next one. How long the driver takes to hear of it is not the page's.
    await page.evaluate(() => {
      let turned = 0;
      addEventListener('wheel', event => { turned = event.timeStamp; }, {capture: true});
      globalThis.stepMs = () => new Promise(resolve => {
        const look = () => {
          if (document.body.dataset.complete !== 'true') return;
          watch.disconnect();
          requestAnimationFrame(() => resolve(performance.now() - turned));
        };
        const watch = new MutationObserver(look);
        addEventListener('wheel', () => watch.observe(document.body, {attributes: true, attributeFilter: ['data-complete']}), {once: true});
      });
    });
    const steps = [];
    const box = await page.locator('#over').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    for (let i = 0; i < 12; ++i) {
      const step = page.evaluate(() => globalThis.stepMs());
      await page.mouse.wheel(0, -300);
      steps.push(Math.round(await step));
      await page.waitForTimeout(100);
      assert.ok(Number(await page.evaluate(() => document.body.dataset.segments)) <= 50_000);
    }
    steps.sort((a, b) => a - b);
    const heap = await page.evaluate(() => performance.memory.usedJSHeapSize / 2 ** 20);
    assert.ok(heap < 200, `${heap} MiB in the page`);
    console.log(`  ${blocks} blocks: first picture ${took} ms, the upload alone ${upload.toFixed(0)} ms, a zoom step ${steps[6]} ms (median), page ${heap.toFixed(0)} MiB`);
    // What is found after the first picture follows.
    await page.waitForFunction(() => /blocks measured\d{5}/.test(document.getElementById('certificate').textContent));
    // The last line of the listing is reached.
    await page.evaluate(() => { const box = document.getElementById('input'); box.scrollTop = box.scrollHeight; });
    await page.waitForFunction(() => /M30/.test(document.getElementById('input').textContent));
  },
};

let failed = 0;
async function run(name, test, options) {
  const page = await open(options);
  try {
    await test(page);
    assert.deepEqual(page.problems.filter(problem => !/status of 4\d\d/.test(problem)), []);
    console.log(`ok   ${name}`);
  } catch (error) {
    ++failed;
    console.log(`FAIL ${name}\n${error.stack}\n${page.problems.join('\n')}`);
    if (screenshots) await page.screenshot({path: join(screenshots, `failed-${failed}.png`)});
  }
  await page.context().close();
}

try {
  // axe comes from outside of the page, which its policy forbids.
  for (const [name, test] of Object.entries(tests))
    await run(name, test, {bypassCSP: name.startsWith('everybody')});
  for (const name of [Object.keys(tests)[0], ...Object.keys(tests).filter(name => name.startsWith('an arc is round'))])
    await run(`without a graphics processor: ${name}`, async page => {
      assert.equal(await page.evaluate(() => document.body.dataset.renderer), 'Canvas2d');
      await tests[name](page);
    }, {no2: true});
  if (screenshots) {
    const page = await open();
    const programs = ['d16_notch_masked', 'circular_transitions', 'd09_keyway_in_a_bore', 'd12_violation_ignored',
      'bottleneck_beyond_window', 'd33_g141_leaves_the_notch', 'd24_hundred_passive_blocks'];
    const paths = [...programs.map(name => join(top, `tests/programs/good/${name}.nc`)), join(top, 'client/samples/bracket.nc'),
      file('notch.nc', notch), file('waves.nc', waves(50_000))];
    for (const [i, path] of paths.entries()) {
      await show(page, path, {tool_radius: path.endsWith('notch.nc') ? '5' : path.endsWith('waves.nc') ? '0.05' : ''});
      await page.waitForTimeout(200);
      await page.screenshot({path: join(screenshots, `${i}.png`)});
    }
  }
} finally {
  await browser.close();
  server.removeAllListeners('exit');
  server.kill();
  rmSync(folder, {recursive: true});
}
process.exit(failed ? 1 : 0);
