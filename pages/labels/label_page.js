// Steps through kicks, plays each, and says to the log what somebody saw. Texts of the log are only ever set as text.
'use strict';

const kEnded = 'trivela label --serve does not answer: it has ended.';
const kBeforeKick_s = 3;  // the video is set so long before the kick
const token = location.hash.slice(1);
const by = (id) => document.getElementById(id);
const words = (label) => label.replaceAll('_', ' ');

let kicks = [];      // of the log
let shown = null;    // place in `kicks`
let playing = null;  // its replay
let videoUtc_s = null;  // UTC at the video's beginning

function remembered(key, fallback) {
  try { return localStorage.getItem(key) ?? fallback; } catch { return fallback; }
}
function remember(key, value) {
  try { localStorage.setItem(key, value); } catch { /* a browser that keeps nothing */ }
}

function tell(sentence, wrong = false) {
  by('said').textContent = sentence;
  by('said').classList.toggle('wrong', wrong);
}

// --- which kicks

const isUnknown = (kick) => ['', 'unknown'].includes(kick.by_hand ?? kick.observed);  // as reports count it
const belongs = {
  unknown: (kick) => isUnknown(kick) && kick.by_hand === null,  // nobody has looked at it
  labelled: (kick) => kick.by_hand !== null,
  all: () => true,
};

// Places of the kicks that are asked for; the one shown stays among them until the next is asked for.
function places() {
  const wanted = belongs[by('which').value];
  return kicks.map((_, i) => i).filter((i) => i === shown || wanted(kicks[i]));
}

function step(forwards) {
  const wanted = belongs[by('which').value];
  const all = kicks.map((_, i) => i).filter((i) => wanted(kicks[i]));
  const from = shown ?? (forwards ? -1 : kicks.length);
  const next = forwards ? all.find((i) => i > from) ?? all[0] : all.findLast((i) => i < from) ?? all.at(-1);
  show(next ?? null);
}

// --- one kick

async function show(place) {
  shown = place;
  playing?.remove();
  playing = null;
  by('empty').hidden = place !== null;
  by('empty').textContent = kicks.length === 0 ? 'The log has no kicks.' : 'There are none of these kicks.';
  describe();
  if (place === null) return;
  const answer = await fetch(`/api/timeline?i=${place}`).catch(() => null);
  if (shown !== place) return;
  if (!answer) return tell(kEnded, true);
  if (!answer.ok) return tell((await answer.json()).error, true);
  const timeline = await answer.json();
  if (shown !== place) return;
  playing = replay(by('replay'), timeline);
  document.body.dataset.shown = kicks[place].kick;
}

function describe() {
  const kick = shown === null ? null : kicks[shown];
  const all = places();
  by('kick').textContent = kick ? `Kick ${kick.kick}, ${all.indexOf(shown) + 1} of ${all.length}` : 'No kick';
  by('facts').textContent = kick ? `${kick.at_s.toFixed(1)} s, ${new Date(kick.utc_ms).toISOString().slice(0, 19)} UTC, ` +
    `${words(kick.policy)}; the observer says ${words(kick.observed || 'nothing')}` +
    (kick.by_hand === null ? '' : `, ${kick.labelled_by} ${words(kick.by_hand)}`) : '';
  by('log').textContent = `${logName}: ${kicks.filter(isUnknown).length} of ${kicks.length} kicks are unknown`;
  for (const button of by('outcomes').children) {
    button.disabled = !kick || !token;
    button.setAttribute('aria-pressed', String(kick?.by_hand === button.dataset.outcome));
  }
  by('withdraw').disabled = !kick || !token || kick.by_hand === null;
  describeVideo();
}

let logName = '';
function take(state) {
  logName = state.log;
  kicks = state.kicks;
}

// null: the label is withdrawn.
async function say(outcome) {
  if (shown === null || !token) return;
  const kick = kicks[shown], place = shown;
  if (!by('who').value.trim()) {
    by('who').focus();
    return tell('Who says so? Your name stands beside each label.', true);
  }
  remember('trivela-who', by('who').value);
  const note = by('note').value || (videoTime() === null ? '' : `video ${clock(videoTime())}`);
  const answer = await fetch('/api/label', {method: 'POST',
    headers: {'Content-Type': 'application/json', 'X-Trivela-Token': token},
    body: JSON.stringify({session_id: kick.session_id, kick_id: kick.kick_id, robot: kick.robot, outcome,
      who: by('who').value, note})}).catch(() => null);
  if (!answer) return tell(`${kEnded} Nothing was written.`, true);
  const said = await answer.json();
  if (!answer.ok) return tell(`${said.error}. Nothing was written.`, true);
  take(said);
  by('note').value = '';
  tell(outcome === null ? `Kick ${kick.kick}: the label is withdrawn` : `Kick ${kick.kick}: ${words(outcome)}`);
  if (shown !== place) return describe();
  if (outcome === null) describe(); else step(true);
}

// --- the video

const clock = (time_s) => `${Math.floor(time_s / 60)}:${(time_s % 60).toFixed(1).padStart(4, '0')}`;

// "12:34", "1:12:34.5" or seconds; null: none.
function seconds(text) {
  const parts = text.trim().split(':').map(Number);
  return text.trim() && parts.length <= 3 && parts.every((part) => Number.isFinite(part) && part >= 0)
    ? parts.reduce((sum, part) => 60 * sum + part, 0) : null;
}

function videoTime() {
  if (videoUtc_s === null || shown === null) return null;
  const time_s = kicks[shown].utc_ms / 1000 - videoUtc_s;
  return time_s >= 0 ? time_s : null;
}

function setVideo(time_s) {
  if (shown === null) return;
  videoUtc_s = kicks[shown].utc_ms / 1000 - time_s;
  remember(`trivela-video ${logName}`, String(videoUtc_s));
  describeVideo();
}

function describeVideo() {
  const time_s = videoTime();
  by('when').textContent = shown === null ? '' : videoUtc_s === null
    ? 'Say once where a kick is in the video: the others follow by their UTC.'
    : time_s === null ? 'The kick was before the video began.' : `This kick is at ${clock(time_s)} of the video.`;
  by('time').value = time_s === null ? '' : clock(time_s);
  if (time_s !== null && !by('video').hidden) by('video').currentTime = Math.max(0, time_s - kBeforeKick_s);
}

// --- what the reader does

by('previous').addEventListener('click', () => step(false));
by('next').addEventListener('click', () => step(true));
by('which').addEventListener('change', () => { shown = null; step(true); });
by('withdraw').addEventListener('click', () => say(null));
by('time').addEventListener('change', () => {
  const time_s = seconds(by('time').value);
  if (time_s === null) tell('A video\'s time is written as 12:34 or 1:02:34.5.', true); else setVideo(time_s);
});
by('file').addEventListener('change', () => {
  const [file] = by('file').files;
  by('video').hidden = by('here').hidden = !file;
  if (by('video').src) URL.revokeObjectURL(by('video').src);
  if (file) by('video').src = URL.createObjectURL(file);
  describeVideo();
});
by('here').addEventListener('click', () => setVideo(by('video').currentTime));
document.addEventListener('keydown', (event) => {
  const writes = event.target.closest('input:not([type="checkbox"]), select, video');
  if (writes || !by('keys').checked || event.ctrlKey || event.altKey || event.metaKey) return;
  const button = document.querySelector(`#outcomes [data-key="${CSS.escape(event.key)}"]:enabled`);
  if (event.key === 'n') step(true);
  else if (event.key === 'p') step(false);
  else if (event.key === 'w' && !by('withdraw').disabled) say(null);
  else if (button) button.click();
  else return;
  event.preventDefault();  // no letter for the field that may have the focus now
});

async function begin() {
  const state = await (await fetch('/api/kicks')).json();
  take(state);
  document.title = `Labels of ${logName}`;
  state.outcomes.forEach((outcome, i) => {
    const button = document.createElement('button'), key = document.createElement('kbd');
    key.textContent = button.dataset.key = i < 10 ? String((i + 1) % 10) : outcome[0];
    button.dataset.outcome = outcome;
    button.setAttribute('aria-keyshortcuts', key.textContent);
    button.append(words(outcome), key);
    button.addEventListener('click', () => say(outcome));
    by('outcomes').append(button);
  });
  by('who').value = remembered('trivela-who', '');
  const kept = Number(remembered(`trivela-video ${logName}`, 'none'));
  videoUtc_s = Number.isFinite(kept) ? kept : null;
  if (!token) tell('This address has no token: open the one that trivela label --serve printed to label.', true);
  step(true);
}

begin();
