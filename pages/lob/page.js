'use strict';

const $ = (id) => document.getElementById(id);
const canvas = $('scan');
const theme = matchMedia('(prefers-color-scheme: dark)');

let setup = null;      // geometry and mount, once the scanner is known
let beams = null;      // cos and sin of each beam's elevation
let lobs = [];
let plan = null;
let status = {};
let frame = null;      // the scan that is drawn
let newest = -1;       // last scan of a live scanner
let chosen = null;     // number of the lob that was clicked
let back = null;       // live: looking back, {position, playing}
let view = null;       // {x, z, scale}: what is in the middle of the canvas, pixels a metre
let colours = {};
let arrivals = [];     // of frames in the last second
let planShown = '';    // what showPlan() has drawn

const live = () => setup && setup.mode === 'live';
const fixed = (value, digits) => value === null || value === undefined ? '–' : value.toFixed(digits);
const at = (x, z) => [canvas.width / 2 + (x - view.x) * view.scale, canvas.height / 2 - (z - view.z) * view.scale];

function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

function notice(text) {
  $('notice').textContent = text;
  $('notice').hidden = !text;
}

async function command(name, args) {
  const answer = await fetch('/api/' + name,
    {method: 'POST', headers: {'Content-Type': 'application/json'}, body: JSON.stringify(args)});
  notice(answer.ok ? '' : (await answer.json()).error);
}

// Only the newest request counts; the one under way is finished first.
function newestOnly(work) {
  let waiting = null;
  let busy = false;
  return async (value) => {
    waiting = {value};
    if (busy) return;
    busy = true;
    while (waiting) {
      const {value: now} = waiting;
      waiting = null;
      try { await work(now); } catch (error) { /* the events say that the server is gone */ }
    }
    busy = false;
  };
}

const player = newestOnly((args) => command('player', args));
const lookAt = newestOnly(async (position) => {
  const answer = await fetch('/api/frame?i=' + position);
  if (answer.ok && back) show(await answer.json());
});

// --- what comes from the server

function takeSetup(data) {
  if (setup && setup.file !== data.file) {
    newest = -1;
    back = null;
  }
  setup = data;
  document.body.dataset.mode = setup.mode;
  const scanner = setup.scanner ? setup.scanner + ', ' : '';
  $('source').textContent = setup.mode === 'live'
    ? `${scanner}${setup.source}, recorded to ${setup.file}` : `${setup.file}: ${scanner}${setup.source}`;
  $('synthetic').hidden = !setup.synthetic;
  $('other').hidden = $('line').hidden = $('follow').hidden = !live();
  if (setup.warnings && setup.warnings.length) notice(setup.warnings.join('; '));
  if (!setup.beams) return;
  beams = {cos: new Float32Array(setup.beams), sin: new Float32Array(setup.beams)};
  for (let i = 0; i < setup.beams; ++i) {
    const angle = setup.first_angle_rad + i * setup.step_rad;
    const elevation = setup.front_elevation_rad + (setup.mirrored ? -angle : angle);
    beams.cos[i] = Math.cos(elevation);
    beams.sin[i] = Math.sin(elevation);
  }
  fit();
}

function decode(data) {
  const bytes = atob(data.ranges);
  const range = new Float32Array(bytes.length / 2);
  for (let i = 0; i < range.length; ++i) {
    range[i] = (bytes.charCodeAt(2 * i) + 256 * bytes.charCodeAt(2 * i + 1)) / 1000;
  }
  return {...data, range};
}

function show(data) {
  frame = decode(data);
  draw();
}

function takeFrame(data) {
  const now = performance.now();
  arrivals = arrivals.filter((t) => now - t < 1000).concat(now);
  newest = Math.max(newest, data.i);
  if (!back) show(data);
  place();
}

function takeStatus(data) {
  status = data;
  const link = $('link');
  if (live()) {
    link.dataset.state = status.link.up ? 'up' : 'down';
    link.textContent = status.link.up ? 'scanner connected' : 'no scanner';
    $('status').textContent = status.link.text;
    const names = {scans: 'scans', lost_scans: 'lost scans', torn_lines: 'torn lines', wrong_sums: 'wrong sums',
      error_replies: 'error replies', error_ranges: 'error codes', time_outs: 'time-outs', reconnects: 'reconnects'};
    $('counters').replaceChildren(...Object.entries(names).flatMap(([key, text]) =>
      [element('dt', text), element('dd', status.link[key], {'data-counter': key})]),
    element('dt', 'not recorded'), element('dd', status.refused, {'data-counter': 'refused'}));
    if (status.trouble) notice(status.trouble);
    showPlan();
  } else {
    link.dataset.state = 'up';
    link.textContent = 'replay';
    $('speed').value = String(status.speed);
    showPlan();
  }
  place();
}

function takeLobs(data) {
  lobs = data.lobs;
  plan = data.plan;
  if (chosen !== null && chosen >= lobs.length) chosen = null;
  $('empty').hidden = data.table.length > 0;
  $('table').tBodies[0].replaceChildren(...data.table.map((row) => {
    const tr = element('tr', '', {'data-power': row.power});
    tr.append(element('td', row.power), element('td', row.trials), element('td', fixed(row.exit_speed_mps, 2)),
      element('td', fixed(row.exit_speed_sd_mps, 3)), element('td', fixed(row.exit_angle_deg, 1)),
      element('td', fixed(row.exit_angle_sd_deg, 2)));
    return tr;
  }));
  showLobs();
  showPlan();
  draw();
}

// --- side

function showLobs() {
  const accepted = lobs.filter((lob) => lob.accepted).length;
  $('count').textContent = lobs.length ? `${accepted} of ${lobs.length} accepted` : 'none yet';
  const typed = $('lobs').querySelector('input')?.value;
  const focused = document.activeElement.closest('#lobs li');
  const held = focused && `li[data-lob="${focused.dataset.lob}"] .${document.activeElement.className}`;
  $('lobs').replaceChildren(...lobs.map((lob, n) => lobItem(lob, n)).reverse());
  const fresh = $('lobs').querySelector('input');
  if (fresh && typed !== undefined) fresh.value = typed;
  if (held) $('lobs').querySelector(held)?.focus();  // the keyboard stays where it was
}

function lobItem(lob, n) {
  const item = element('li', '', {'data-lob': n, 'data-accepted': lob.accepted});
  if (n === chosen) item.className = 'chosen';
  const fitted = lob.effective;
  const values = fitted
    ? `${fitted.exit_speed_mps.value.toFixed(2)} m/s at ${fitted.exit_angle_deg.value.toFixed(1)}°` : 'no fit';
  item.append(element('button', `#${n + 1}  power ${lob.power ?? '?'}  ${values}`, {class: 'values', 'aria-expanded': n === chosen}));
  const judge = element('button', lob.accepted ? 'reject' : 'accept', {class: 'judge'});
  judge.disabled = !lob.accepted && !fitted;
  judge.onclick = (event) => {
    event.stopPropagation();
    const reason = item.querySelector('input');
    command('verdict', {lob: n, accepted: !lob.accepted, why: lob.accepted && reason ? reason.value : ''});
  };
  item.append(judge, element('span', lob.accepted ? 'accepted' : lob.why, {class: 'said'}));
  item.onclick = (event) => event.target.tagName === 'INPUT' || choose(n);
  if (n === chosen) item.append(details(lob));
  return item;
}

function details(lob) {
  const more = element('div', '', {class: 'more'});
  const pair = (value, digits) => `${value.value.toFixed(digits)} ± ${value.se.toFixed(digits + 1)}`;
  if (lob.effective) {
    more.append(element('div', `effective: ${pair(lob.effective.exit_speed_mps, 2)} m/s, ` +
      `${pair(lob.effective.exit_angle_deg, 1)}°, H ${pair(lob.effective.height_m, 2)} m, ` +
      `D ${pair(lob.effective.distance_m, 2)} m`));
  }
  if (lob.true) {
    more.append(element('div', `true: ${pair(lob.true.exit_speed_mps, 2)} m/s, ` +
      `${pair(lob.true.exit_angle_deg, 1)}°, Cd ${pair(lob.true.Cd, 2)}`));
  }
  const where = element('button', 'go there', {class: 'there'});
  where.onclick = (event) => {
    event.stopPropagation();
    seek(lob.end);
  };
  more.append(element('div', `${lob.centres.length} scans with the ball, at ${lob.t_s.toFixed(2)} s `), where);
  if (lob.accepted) more.append(element('input', '', {type: 'text', class: 'why', 'aria-label': 'why it is rejected', placeholder: 'why it is rejected (optional)'}));
  return more;
}

function choose(n) {
  chosen = chosen === n ? null : n;
  showLobs();
  draw();
}

function showPlan() {
  // Buttons that are replaced while a finger is on them are not clicked.
  const wanted = JSON.stringify([plan, status.power, live()]);
  if (wanted === planShown) return;
  planShown = wanted;
  $('power').hidden = !live() && !plan && status.power === null;
  $('tested').textContent = status.power ?? 'not set';
  $('progress').hidden = !plan;
  $('plan').hidden = !plan;
  if (!plan) return;
  const kicks = plan.powers.length * plan.trials;
  const done = plan.powers.reduce((sum, row) => sum + Math.min(row.done, plan.trials), 0);
  const now = plan.powers.find((row) => row.power === status.power);
  const next = live() && now && now.done < plan.trials ? `; next: power ${now.power}, kick ${now.done + 1}` : '';
  const more = live() && status.power === null ? ' Choose a power for more.' : '';
  $('progress').textContent = done >= kicks ? `All ${kicks} kicks are done.${more}` : `${done} of ${kicks} kicks done${next}`;
  $('plan').replaceChildren(...plan.powers.map((row) => {
    const chip = element('button', row.power,
      {'data-power': row.power, 'aria-pressed': row.power === status.power});
    chip.classList.toggle('done', row.done >= plan.trials);
    chip.append(element('small', '●'.repeat(row.done) + '○'.repeat(Math.max(0, plan.trials - row.done))));
    chip.disabled = !live();
    chip.onclick = () => command('set-point', {power: row.power});
    return chip;
  }));
}

// --- time

function place() {
  const scans = live() ? newest + 1 : status.scans || 0;
  const position = back ? back.position : live() ? newest : status.position || 0;
  $('scrubber').max = Math.max(0, scans - 1);
  if (document.activeElement !== $('scrubber') || !$('scrubber').matches(':active')) $('scrubber').value = position;
  const playing = back ? back.playing : live() ? true : status.playing;
  $('play').textContent = playing ? 'pause' : 'play';
  $('follow').dataset.on = !back;
  const recent = arrivals.filter((t) => performance.now() - t < 1000).length;
  const parts = [frame ? `${frame.t_s.toFixed(2)} s` : '', `scan ${position + 1} of ${scans}`,
    live() && !back && status.link && status.link.up ? `${recent} scans/s` : ''];
  $('place').textContent = scans > 0 ? parts.filter((part) => part).join(' · ') : 'no scan yet';
  document.body.dataset.position = position;
}

function seek(position) {
  if (!live()) return player({position});
  if (newest < 0) return;
  back = {position: Math.min(Math.max(position, 0), newest), playing: back ? back.playing : false};
  lookAt(back.position);
  place();
}

function step(scans) {
  if (!live()) return player({step: scans});
  if (back) back.playing = false;
  seek((back ? back.position : newest) + scans);
}

function toggle() {
  if (!live()) return player({playing: !status.playing});
  if (!back) return seek(newest);
  back.playing = !back.playing;
  place();
}

function follow() {
  back = null;
  place();
}

// Looking back plays by the browser's clock; the record goes on meanwhile.
let ticked = performance.now();
function tick(now) {
  const passed_s = Math.min(0.25, (now - ticked) / 1000);
  ticked = now;
  if (back && back.playing && setup.scan_period_s) {
    const before = back.position;
    back.exact = (back.exact !== undefined && Math.floor(back.exact) === before ? back.exact : before) +
      passed_s * Number($('speed').value) / setup.scan_period_s;
    back.position = Math.floor(Math.min(Math.max(back.exact, 0), newest));
    if (back.position !== before) lookAt(back.position);
    if (back.position === newest && back.exact > newest) follow();
    place();
  }
  requestAnimationFrame(tick);
}

// --- picture

function readColours() {
  const style = getComputedStyle(document.documentElement);
  const names = ['paper', 'quiet', 'grid', 'background', 'object', 'outline', 'centre', 'laser', 'curve'];
  for (const name of names) {
    colours[name] = style.getPropertyValue('--' + name).trim();
  }
  draw();
}

function fit() {
  const left = Math.min(-0.8, setup && setup.laser ? setup.laser[0] - 0.8 : -0.8);
  const right = 12.4;
  const top = 3.9;
  const floor = -0.6;
  const scale = Math.min(canvas.width / (right - left), canvas.height / (top - floor));
  view = {x: (left + right) / 2, z: floor + canvas.height / 2 / scale, scale};
  draw();
}

function resize() {
  const ratio = devicePixelRatio || 1;
  const box = canvas.getBoundingClientRect();
  canvas.width = Math.round(box.width * ratio);
  canvas.height = Math.round(box.height * ratio);
  fit();
}

let asked = false;
function draw() {
  if (asked) return;
  asked = true;
  requestAnimationFrame(() => { asked = false; paint(); });
}

function paint() {
  if (!view || !canvas.width) return;
  const g = canvas.getContext('2d');
  const ratio = devicePixelRatio || 1;
  g.setTransform(1, 0, 0, 1, 0, 0);
  g.fillStyle = colours.paper;
  g.fillRect(0, 0, canvas.width, canvas.height);
  paintGrid(g, ratio);
  if (frame && beams && frame.range.length === beams.cos.length) paintReturns(g, ratio);
  const lob = chosen !== null ? lobs[chosen] : !frame || !frame.track.length ? lobs[lobs.length - 1] : null;
  if (lob) paintLob(g, ratio, lob);
  if (frame) paintBall(g, ratio);
  if (frame && !frame.ready) words(g, ratio, 'learning the background: keep the scan plane free');
  if (setup && setup.laser) dot(g, ...at(...setup.laser), 7 * ratio, colours.laser);
  if (frame) document.body.dataset.drawn = frame.i;
}

function paintGrid(g, ratio) {
  const reach = [canvas.width / 2 / view.scale, canvas.height / 2 / view.scale];
  const every = [0.5, 1, 2, 5, 10, 20].find((metres) => metres * view.scale > 44 * ratio) || 50;
  g.lineWidth = ratio;
  g.font = `${11 * ratio}px system-ui, sans-serif`;
  const line = (a, b, colour) => {
    g.strokeStyle = colour;
    g.beginPath();
    g.moveTo(...a);
    g.lineTo(...b);
    g.stroke();
  };
  for (let x = Math.ceil((view.x - reach[0]) / every) * every; x < view.x + reach[0]; x += every) {
    const px = at(x, 0)[0];
    line([px, 0], [px, canvas.height], colours.grid);
    g.fillStyle = colours.quiet;
    g.fillText(`${x} m`, px + 3 * ratio, canvas.height - 5 * ratio);
  }
  for (let z = Math.ceil((view.z - reach[1]) / every) * every; z < view.z + reach[1]; z += every) {
    const py = at(0, z)[1];
    line([0, py], [canvas.width, py], z === 0 ? colours.quiet : colours.grid);
    g.fillStyle = colours.quiet;
    if (py > 14 * ratio && py < canvas.height - 22 * ratio) g.fillText(`${z} m`, 4 * ratio, py - 3 * ratio);
  }
}

function paintReturns(g, ratio) {
  const kind = new Uint8Array(frame.range.length);
  for (const [first, last, what] of frame.runs) kind.fill(what, first, last + 1);
  const points = (wanted, size, colour) => {
    g.fillStyle = colour;
    for (let i = 0; i < kind.length; ++i) {
      if ((kind[i] > 0) !== wanted || frame.range[i] === 0) continue;
      const [x, y] = at(setup.laser[0] + frame.range[i] * beams.cos[i], setup.laser[1] + frame.range[i] * beams.sin[i]);
      g.fillRect(x - size / 2, y - size / 2, size, size);
    }
  };
  points(false, 2.5 * ratio, colours.background);
  if (theme.matches) points(true, 6 * ratio, colours.outline);
  points(true, 4 * ratio, colours.object);
}

function paintLob(g, ratio, lob) {
  g.globalAlpha = lob.accepted ? 1 : 0.5;
  if (lob.curve) {
    g.strokeStyle = colours.curve;
    g.lineWidth = 2 * ratio;
    g.setLineDash(lob.accepted ? [] : [6 * ratio, 5 * ratio]);
    g.beginPath();
    const half = Math.sqrt(Math.max(0, lob.curve.z_m) / lob.curve.k_per_m);
    for (let n = 0; n <= 80; ++n) {
      const x = lob.curve.x_m + half * (n / 40 - 1);
      g.lineTo(...at(x, lob.curve.z_m - lob.curve.k_per_m * (x - lob.curve.x_m) ** 2));
    }
    g.stroke();
    g.setLineDash([]);
  }
  for (const place of lob.centres) dot(g, ...at(...place), 2.5 * ratio, colours.centre);
  g.globalAlpha = 1;
}

function paintBall(g, ratio) {
  for (const place of frame.track) dot(g, ...at(...place), 2.5 * ratio, colours.centre);
  if (!frame.centre) return;
  const [x, y] = at(...frame.centre);
  g.strokeStyle = colours.centre;
  g.lineWidth = ratio;
  g.beginPath();
  g.arc(x, y, setup.ball_radius_m * view.scale, 0, 2 * Math.PI);
  g.stroke();
  dot(g, x, y, 5 * ratio, colours.centre);
}

function words(g, ratio, text) {
  g.fillStyle = colours.curve;
  g.font = `${15 * ratio}px system-ui, sans-serif`;
  g.textAlign = 'center';
  g.fillText(text, canvas.width / 2, 28 * ratio);
  g.textAlign = 'start';
}

function dot(g, x, y, radius, colour) {
  g.fillStyle = colour;
  g.beginPath();
  g.arc(x, y, radius, 0, 2 * Math.PI);
  g.fill();
}

// --- hands

$('play').onclick = toggle;
$('back').onclick = () => step(-1);
$('forward').onclick = () => step(1);
$('follow').onclick = follow;
$('fit').onclick = fit;
$('speed').onchange = () => live() ? place() : player({speed: Number($('speed').value)});
$('scrubber').oninput = () => seek(Number($('scrubber').value));
$('learn').onclick = () => command('background', {});
$('other').onsubmit = (event) => {
  event.preventDefault();
  if ($('number').value) command('set-point', {power: Number($('number').value)});
};
document.addEventListener('keydown', (event) => {
  const {tagName} = event.target;
  if (['INPUT', 'SELECT'].includes(tagName) || (tagName === 'BUTTON' && event.key === ' ')) return;
  const keys = {ArrowLeft: () => step(-1), ArrowRight: () => step(1), ' ': toggle};
  if (!keys[event.key]) return;
  event.preventDefault();
  keys[event.key]();
});
canvas.addEventListener('wheel', (event) => {
  event.preventDefault();
  const ratio = devicePixelRatio || 1;
  const before = [view.x + (event.offsetX * ratio - canvas.width / 2) / view.scale,
    view.z - (event.offsetY * ratio - canvas.height / 2) / view.scale];
  const zoom = Math.min(Math.max(view.scale * Math.exp(-event.deltaY / 400), 4), 4000) / view.scale;
  view = {x: before[0] + (view.x - before[0]) / zoom, z: before[1] + (view.z - before[1]) / zoom,
    scale: view.scale * zoom};
  draw();
}, {passive: false});
canvas.addEventListener('pointermove', (event) => {
  if (!event.buttons) return;
  const ratio = devicePixelRatio || 1;
  view.x -= event.movementX * ratio / view.scale;
  view.z += event.movementY * ratio / view.scale;
  draw();
});

const events = new EventSource('/api/events');
const takers = {setup: takeSetup, lobs: takeLobs, status: takeStatus, frame: takeFrame};
for (const [name, take] of Object.entries(takers)) {
  events.addEventListener(name, (event) => take(JSON.parse(event.data)));
}
events.onerror = () => {
  $('link').dataset.state = 'down';
  $('link').textContent = 'server gone';
};
theme.addEventListener('change', readColours);
new ResizeObserver(resize).observe(canvas);
readColours();
requestAnimationFrame(tick);
