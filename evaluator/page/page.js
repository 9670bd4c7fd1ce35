// The list of kicks of a report: its filter, kept in the address, and the replay of a kick. Hypotheses are read when the first
// one is asked for.
(() => {
  'use strict';
  const byId = (id) => document.getElementById(id);
  const form = byId('filter');
  const rows = [...document.querySelectorAll('#kicks tbody tr')];
  const stage = byId('replay-stage');
  let timelines = null;
  let shown = null;  // {player, number, from}

  // --- filter

  const fields = form ? [...form.querySelectorAll('[data-filter]')] : [];

  function fits(row, wanted) {
    for (const [key, value] of Object.entries(wanted)) {
      const distance = Number(row.dataset.distance);
      if (key === 'near' ? distance < Number(value) : key === 'far' ? distance > Number(value) : row.dataset[key] !== value)
        return false;
    }
    return true;
  }

  function wantedNow() {
    return Object.fromEntries(fields.filter((field) => field.value !== '').map((field) => [field.dataset.filter, field.value]));
  }

  function remember() {
    const state = new URLSearchParams(wantedNow());
    if (shown) state.set('kick', shown.number);
    const hash = state.toString();
    try {
      history.replaceState(null, '', hash ? `#?${hash}` : location.href.split('#')[0]);
    } catch { /* where the address may not be changed the page works without */ }
  }

  function filter() {
    const wanted = wantedNow();
    let n = 0;
    for (const row of rows) {
      row.hidden = !fits(row, wanted);
      n += row.hidden ? 0 : 1;
    }
    byId('shown').textContent = `${n} of ${rows.length} kicks`;
  }

  // --- replay

  function words(timeline) {
    const at = timeline.utc_ms > 1e12 ? new Date(timeline.utc_ms).toISOString().replace('T', ' ').replace('Z', ' UTC') : '';
    return [`Kick ${timeline.kick}`, timeline.policy, `half ${timeline.half}`, at].filter((text) => text).join(', ');
  }

  function close() {
    if (!shown) return;
    const from = shown.from;
    shown.player.remove();
    shown = null;
    byId('replay').hidden = true;
    remember();
    if (from) from.focus();
  }

  function open(number, from) {
    timelines ??= JSON.parse(byId('timelines').textContent);
    const timeline = timelines[number];
    if (!timeline) return;
    if (shown) shown.player.remove();
    byId('replay').hidden = false;
    byId('replay-words').textContent = words(timeline);
    shown = {player: replay(stage, timeline), number, from};
    for (const row of rows) row.classList.toggle('chosen', row.id === `k${number}`);
    remember();
    byId('replay').scrollIntoView({block: 'nearest'});
    stage.querySelector('.replay-play').focus({preventScroll: true});
  }

  function restore() {
    if (!location.hash.startsWith('#?')) return;
    const state = new URLSearchParams(location.hash.slice(2));
    for (const field of fields) field.value = state.get(field.dataset.filter) ?? '';
    filter();
    if (state.has('kick')) open(Number(state.get('kick')), null);
  }

  if (form) {
    form.hidden = false;
    form.addEventListener('submit', (event) => event.preventDefault());
    form.addEventListener('input', () => { filter(); remember(); });
    form.addEventListener('reset', () => setTimeout(() => { filter(); remember(); }));
    filter();
  }
  if (stage) {
    for (const button of document.querySelectorAll('[data-replay]')) {
      button.hidden = false;
      button.addEventListener('click', () => open(Number(button.dataset.replay), button));
    }
    for (const mark of document.querySelectorAll('[data-kick]')) {
      mark.addEventListener('click', () => open(Number(mark.dataset.kick), document.querySelector(`#k${mark.dataset.kick} button`)));
    }
    byId('replay-close').addEventListener('click', close);
    document.addEventListener('keydown', (event) => { if (event.key === 'Escape') close(); });
    restore();
  } else if (form) {
    restore();
  }
  document.documentElement.dataset.ready = 'true';
})();
