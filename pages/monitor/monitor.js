import {Pitch} from './pitch.js';

const $ = (id) => document.getElementById(id);
const kSpeech_ms = 5000;   // a screen reader is told no more often
const kSilent_ms = 2000;   // without a picture for longer it is of the past
const kCalmFrame_ms = 200; // where the reader wants less motion
const kAgain_ms = 2000;

const pitch = new Pitch($('pitch'));
const calm = matchMedia('(prefers-reduced-motion: reduce)');
let frame = null;      // the newest pitch
let match = null;      // the newest of all else
let paused = false;
let arrived = 0;       // when the newest pitch came, by performance.now()
let drawn = 0;
let pending = false;
let told = new Set();  // names of alarms that were spoken of
let toldAt = -kSpeech_ms;

// Everything that came over the wire becomes text, never markup.
function element(name, text, attributes = {}) {
  const made = document.createElement(name);
  made.textContent = text;
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  return made;
}

// Nothing is touched that stays as it is: a screen reader and a selection keep their place.
function setText(target, text) {
  if (target.textContent !== text) target.textContent = text;
}

function replace(target, state, make) {
  const now = JSON.stringify(state);
  if (target.dataset.state === now) return;
  target.dataset.state = now;
  target.replaceChildren(...make());
}

const percent = (part) => part === null || part === undefined ? '–' : `${(100 * part).toFixed(0)} %`;
const fixed = (value, digits, unit = '') => value === null || value === undefined ? '–' : value.toFixed(digits) + unit;
const words = (name) => String(name).replaceAll('_', ' ');
const robotName = (id) => match?.names[id] ? `${id} ${match.names[id]}` : String(id);
const ago = (since_ms) => {
  const s = Math.max(0, Math.round(((frame?.now_ms ?? since_ms) - since_ms) / 1000));
  return s < 60 ? `${s} s` : `${Math.floor(s / 60)} min ${s % 60} s`;
};

// --- robots in words

function cardOf(id) {
  const there = $(`robot-${id}`);
  if (there) return there;
  const card = element('li', '', {id: `robot-${id}`});
  card.append(element('strong', '', {class: 'name'}), element('span', '', {class: 'does'}), element('span', '', {class: 'why'}),
    element('span', '', {class: 'charge'}), element('span', '', {class: 'numbers'}), element('span', '', {class: 'learned'}));
  const bar = element('meter', '', {min: 0, max: 1, low: 0.5, high: 0.89, optimum: 1, 'aria-label': `charge of robot ${id}`});
  card.append(bar);
  $('robots').append(card);
  return card;
}

function showRobot(robot) {
  const card = cardOf(robot.id);
  const part = (name) => card.querySelector('.' + name);
  card.className = robot.fires ? 'fires' : robot.fresh ? '' : 'old';
  setText(part('name'), robotName(robot.id));
  setText(part('does'), robot.fires ? 'fires' : 'holds');
  setText(part('why'), robot.why);
  const {kicker} = robot;
  setText(part('charge'), kicker ? `${words(kicker.state)}, charge ${percent(kicker.charge)}${kicker.modelled ? ' (computed)' : ''}`
    : 'no kicker_status is received');
  const meter = card.querySelector('meter');
  meter.hidden = !kicker || kicker.charge === null;
  if (!meter.hidden) meter.value = kicker.charge;
  setText(part('numbers'), robot.policy === undefined ? '' : [words(robot.policy), robot.segments ? fixed(robot.distance, 1, ' m') : '',
    robot.power === null ? '' : `power ${fixed(robot.power, 1)}`, robot.p === null ? '' : `chance ${percent(robot.p)}`,
    robot.segments ? robot.segments.meet ? 'segments meet' : 'segments apart' : ''].filter((text) => text).join(', '));
  setText(part('learned'), learnedText(robot.learned));
}

// What its kicks have shown of its kicker, with standard errors.
function learnedText(learned) {
  if (!learned) return '';
  const signed = (value, digits) => (value < 0 ? '−' : '+') + Math.abs(value).toFixed(digits);
  return `${learned.kicks} kicks seen: exit speed ${signed(learned.speed_percent, 1)} % (±${fixed(learned.speed_se_percent, 1)}), ` +
    `angle ${signed(learned.angle_deg, 1)}° (±${fixed(learned.angle_se_deg, 1)}) from its file, ` +
    (learned.used ? 'decisions go by it' : 'decisions do not go by it');
}

// --- the rest

function showGame() {
  const {referee} = match;
  if (!referee) return setText($('game'), 'no referee received yet');
  const clock = referee.clock_s === null ? '' :
    `, ${Math.floor(referee.clock_s / 60)}:${String(referee.clock_s % 60).padStart(2, '0')}`;
  const restart = referee.restart === 'none' ? '' : `, ${words(referee.restart)}${referee.ours ? ' for us' : ''}`;
  setText($('game'), `half ${referee.half}${clock}, ${referee.own} : ${referee.other}, ` +
    `${match.over ? 'the match is over' : referee.playing ? 'playing' : 'stopped'}${match.over ? '' : restart}`);
}

// The interval as a picture beside its numbers.
function intervalCell([lo, hi], value) {
  const cell = element('td', `${percent(lo)} to ${percent(hi)}`, {class: 'interval'});
  const bar = element('span', '', {class: 'bar', 'aria-hidden': 'true'});
  const range = element('i', '', {class: 'range'});
  range.style.setProperty('left', `${100 * lo}%`);
  range.style.setProperty('width', `${100 * (hi - lo)}%`);
  bar.append(range);
  if (value !== null) {
    const dot = element('i', '', {class: 'dot'});
    dot.style.setProperty('left', `${100 * value}%`);
    bar.append(dot);
  }
  cell.append(bar);
  return cell;
}

function showTable() {
  const {table} = match;
  replace($('table').tBodies[0], table.rows, () => table.rows.map((row) => {
    const line = element('tr', '');
    line.append(element('th', words(row.policy), {scope: 'row'}));
    for (const count of [row.inside, row.goals, row.outside, row.unknown, row.under_way]) line.append(element('td', count));
    line.append(element('td', percent(row.efficiency)), intervalCell(row.interval, row.efficiency));
    return line;
  }));
  const {difference} = table;
  const points = (part) => `${part > 0 ? '+' : part < 0 ? '−' : ''}${Math.abs(100 * part).toFixed(0)}`;
  setText($('difference'), difference ? `${words(difference.newer)} less ${words(difference.older)}: ${points(difference.value)} points, ` +
    `95 % ${points(difference.interval[0])} to ${points(difference.interval[1])}, however often you look. ` +
    (difference.interval[0] <= 0 && difference.interval[1] >= 0 ? 'It may be nothing.' : 'It is not nothing.')
    : 'No two policies to compare yet.');
}

function became(kick) {
  if (kick.fate === 'refused') return `refused: ${words(kick.refusal)}`;
  return kick.outcome === undefined || kick.outcome === kick.fate ? kick.fate : `${kick.fate}: ${words(kick.outcome)}`;
}

function showKicks() {
  replace($('kicks').tBodies[0], [match.kicks, match.names], () => match.kicks.map((kick) => {
    const line = element('tr', '', {class: kick.fate.replace(' ', '-')});
    line.append(element('th', robotName(kick.robot), {scope: 'row'}), element('td', kick.policy === null ? 'not received' : words(kick.policy)),
      element('td', fixed(kick.distance, 1, ' m')), element('td', fixed(kick.power, 1) + (kick.kind ? `, kind ${kick.kind}` : '')), element('td', percent(kick.p)),
      element('td', became(kick), {class: 'became'}));
    return line;
  }));
}

function showAlarms() {
  const {alarms, mended} = match;
  replace($('alarm-list'), alarms, () => alarms.map((alarm) => {
    const line = element('li', alarm.text);
    line.append(element('span', '', {class: 'since', 'data-since': alarm.since_ms}));
    return line;
  }));
  $('alarms').dataset.any = alarms.length > 0;
  $('quiet').hidden = alarms.length > 0;
  replace($('mended').querySelector('ul'), mended, () => mended.map((alarm) =>
    element('li', `${alarm.text}: for ${((alarm.to_ms - alarm.from_ms) / 1000).toFixed(1)} s`)));
  $('mended').hidden = mended.length === 0;
}

// What changed, once in a while.
function speak() {
  if (!match || performance.now() - toldAt < kSpeech_ms) return;
  const now = new Map(match.alarms.map((alarm) => [alarm.name, alarm.text]));
  const fresh = [...now].filter(([name]) => !told.has(name)).map(([, text]) => text);
  const gone = [...told].filter((name) => !now.has(name)).length;
  if (fresh.length === 0 && gone === 0) return;
  $('said').textContent = [fresh.length ? `Alarm: ${fresh.join('; ')}.` : '', gone ? `${gone} mended.` : ''].join(' ').trim();
  told = new Set(now.keys());
  toldAt = performance.now();
}

function showMatch() {
  setText($('title'), match.title ? `Monitor: ${match.title}` : 'Monitor');
  document.title = `${match.alarms.length ? `(${match.alarms.length}) ` : ''}${match.title || 'Monitor'} · Trivela`;
  const simulated = match.simulated.length > 0;
  $('simulated').hidden = !simulated;
  setText($('simulated'), `simulated: ${match.simulated.join(', ')}`);
  for (const figure of document.querySelectorAll('.mark')) setText(figure, simulated ? ' (simulated)' : '');
  pitch.setField(match.field, simulated);
  showGame();
  showAlarms();
  showTable();
  showKicks();
  setText($('nodes'), match.nodes.length ? `${match.nodes.length}: ${match.nodes.join(', ')}` : 'nobody but this page');
  setText($('missed'), match.missed === 0 ? 'This page missed no message.' : `This page missed ${match.missed} messages.`);
}

function draw(time) {
  pending = false;
  if (paused || !frame) return;
  if (calm.matches && time - drawn < kCalmFrame_ms) return;
  drawn = time;
  pitch.draw(frame);
  for (const robot of frame.robots) showRobot(robot);
  $('nobody').hidden = frame.robots.length > 0;
  document.body.dataset.frames = Number(document.body.dataset.frames ?? 0) + 1;
}

function look() {
  for (const since of document.querySelectorAll('.since')) setText(since, ` for ${ago(Number(since.dataset.since))}`);
  const old = performance.now() - arrived > kSilent_ms;
  if (arrived && old && $('link').dataset.state === 'up') setLink('old', 'the picture stands still');
  speak();
}

function setLink(state, text) {
  $('link').dataset.state = state;
  setText($('link'), text);
}

$('pause').addEventListener('click', () => {
  paused = !paused;
  $('pause').setAttribute('aria-pressed', paused);
  document.body.classList.toggle('paused', paused);
  if (!paused && match) showMatch();
});

function follow() {
  const events = new EventSource('/api/events');
  events.addEventListener('pitch', (event) => {
    frame = JSON.parse(event.data);
    arrived = performance.now();
    setLink('up', paused ? 'live, paused here' : 'live');
    if (!pending) {
      pending = true;
      requestAnimationFrame(draw);
    }
  });
  events.addEventListener('match', (event) => {
    match = JSON.parse(event.data);
    if (!paused) showMatch();
  });
  events.onerror = () => {
    setLink('down', 'no connection');
    if (events.readyState !== EventSource.CLOSED) return;  // it comes back by itself
    events.close();
    setTimeout(follow, kAgain_ms);
  };
}

// The token stays in the cookie, not in what a person copies or shows.
if (location.search) history.replaceState(null, '', location.pathname + location.hash);
follow();
setInterval(look, 500);
