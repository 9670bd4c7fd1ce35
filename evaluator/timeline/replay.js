// replay(container, timeline): draws the timeline of a kick (evaluator/timeline/kick_timeline.hpp) from above and from the side and
// plays it. Returns {pause(), show(t_ms), remove()}. Places in centimetres of F, instants in milliseconds after the decision.
const replay = (() => {
  'use strict';
  const kRobot_cm = 24, kBall_cm = 11, kGoalDepth_cm = 50, kGoalArea_cm = 75, kPenaltyArea_cm = 225;
  const kStill_ms = 300;  // older samples say nothing of now
  const kStep_ms = 40;
  const kCalmStep_ms = 200;  // where the reader wants less motion
  const svgSpace = 'http://www.w3.org/2000/svg';

  function mark(name, attributes, ...children) {
    const element = document.createElementNS(svgSpace, name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    element.append(...children);
    return element;
  }

  function part(name, text, attributes = {}) {
    const element = document.createElement(name);
    element.textContent = text;
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return element;
  }

  // --- what is known of an instant

  // Place of the last sample at or before t_ms; -1: none.
  function before(track, t_ms) {
    let low = 0, high = track.t_ms.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (track.t_ms[middle] <= t_ms) low = middle + 1; else high = middle;
    }
    return low - 1;
  }

  // {x, y, z, heading} between the samples around t_ms; null: the track says nothing of that instant.
  function at(track, t_ms) {
    if (!track) return null;
    const i = before(track, t_ms);
    const last = track.t_ms.length - 1;
    if (i < 0) return null;
    const gap = i < last ? track.t_ms[i + 1] - track.t_ms[i] : 0;
    if (t_ms - track.t_ms[i] > kStill_ms && (i === last || gap > kStill_ms)) return null;
    const share = i < last && gap <= kStill_ms ? (t_ms - track.t_ms[i]) / gap : 0;
    const mix = (values) => values[i] + share * ((i < last ? values[i + 1] : values[i]) - values[i]);
    const now = {x: mix(track.x_cm), y: mix(track.y_cm), z: track.z_cm ? mix(track.z_cm) : kBall_cm};
    if (track.heading_mrad) {
      const full = 2000 * Math.PI;
      const turn = i < last ? track.heading_mrad[i + 1] - track.heading_mrad[i] : 0;
      now.heading = (track.heading_mrad[i] + share * (turn - full * Math.round(turn / full))) / 1000;
    }
    return now;
  }

  // The flight camera's word once the ball is away, before it the robot's belief.
  function ballAt(timeline, t_ms) {
    return (t_ms >= (timeline.released_ms ?? 0) && at(timeline.flight, t_ms)) || at(timeline.ball, t_ms);
  }

  function span(timeline) {
    const instants = [0, timeline.released_ms ?? 0];
    for (const track of [timeline.path, timeline.ball, timeline.flight, timeline.opponent]) {
      if (track) instants.push(track.t_ms[0], track.t_ms[track.t_ms.length - 1]);
    }
    if (timeline.observed && timeline.observed.t_ms !== undefined) instants.push(timeline.observed.t_ms);
    return [Math.min(...instants), Math.max(...instants)];
  }

  const path = (track, upTo_ms, height) => {
    const n = before(track, upTo_ms) + 1;
    let text = '';
    for (let i = 0; i < n; ++i) {
      const broken = i === 0 || track.t_ms[i] - track.t_ms[i - 1] > kStill_ms;
      text += `${broken ? 'M' : 'L'}${height ? track.y_cm[i] : track.x_cm[i]} ${-(height ? track.z_cm[i] : track.y_cm[i])}`;
    }
    return text;
  };

  // --- from above: x to the right, y upwards

  function box(timeline) {
    const {pitch, segments} = timeline;
    const xs = [-pitch.goal_half_width_cm - 100, pitch.goal_half_width_cm + 100, segments.s2_cm[0], segments.s2_cm[2]];
    const ys = [pitch.goal_y_cm + kGoalDepth_cm + 40, segments.s1_cm[1] - 120];
    const reach = 100 + pitch.side_line_x_cm;
    for (const track of [timeline.path, timeline.ball, timeline.flight]) {
      if (!track) continue;
      xs.push(...track.x_cm.filter((x) => Math.abs(x) < reach));
      ys.push(...track.y_cm.filter((y) => Math.abs(y) < Math.abs(pitch.goal_y_cm) + 150));
    }
    let [left, right] = [Math.min(...xs) - 60, Math.max(...xs) + 60];
    let [low, high] = [Math.min(...ys) - 40, Math.max(...ys)];
    const wanted = 4 / 3;
    const missing = wanted * (high - low) - (right - left);
    if (missing > 0) { left -= missing / 2; right += missing / 2; }
    if (missing < 0) low += missing / wanted;
    return [left, -high, right - left, high - low];
  }

  function lines(timeline) {
    const {goal_y_cm: y, goal_half_width_cm: w, side_line_x_cm: side, post_cm: post} = timeline.pitch;
    const out = y < 0 ? -1 : 1;
    const area = (depth) => `M${-w - depth} ${-y}V${-(y - out * depth)}H${w + depth}V${-y}`;
    return [
      mark('rect', {class: 'grass', x: -side, y: -Math.abs(y), width: 2 * side, height: 2 * Math.abs(y)}),
      mark('path', {class: 'line', d: `M${-side} ${y}V${-y}H${side}V${y}ZM${-side} 0H${side}${area(kGoalArea_cm)}` +
        area(kPenaltyArea_cm)}),
      mark('circle', {class: 'line', cx: 0, cy: 0, r: 200}),
      mark('path', {class: 'goal', d: `M${-w} ${-y}v${-out * kGoalDepth_cm}h${2 * w}v${out * kGoalDepth_cm}`}),
      mark('rect', {class: 'post', x: -w - post, y: -y - post / 2, width: post, height: post}),
      mark('rect', {class: 'post', x: w, y: -y - post / 2, width: post, height: post})];
  }

  function cross(x, y, size) {
    return mark('path', {class: 'predicted', d: `M${x - size} ${y - size}l${2 * size} ${2 * size}m0 ${-2 * size}l${-2 * size} ` +
      `${2 * size}`});
  }

  function above(timeline) {
    const [s1x, s1y, s1u, s1v] = timeline.segments.s1_cm;
    const [s2x, s2y, s2u, s2v] = timeline.segments.s2_cm;
    const goal = timeline.pitch.goal_y_cm;
    const parts = {
      trail: mark('path', {class: 'trail robot-trail', d: ''}),
      ballTrail: mark('path', {class: 'trail ball-trail', d: ''}),
      segments: mark('g', {class: 'segments'},
        mark('line', {class: 's1', x1: s1x, y1: -s1y, x2: s1u, y2: -s1v}),
        mark('line', {class: 's2', x1: s2x, y1: -s2y, x2: s2u, y2: -s2v})),
      robot: mark('g', {class: 'robot'}, mark('circle', {r: kRobot_cm}), mark('path', {d: `M0 0V${-kRobot_cm}`})),
      others: mark('g', {class: 'other'}, ...(timeline.others_cm ?? []).map(([x, y]) => mark('circle', {cx: x, cy: -y, r: kRobot_cm}))),
      keeper: timeline.keeper_x_cm === undefined ? null : mark('rect', {class: 'other', x: timeline.keeper_x_cm - kRobot_cm,
        y: -goal - kRobot_cm, width: 2 * kRobot_cm, height: 2 * kRobot_cm}),
      opponent: mark('g', {class: 'opponent'}, mark('circle', {r: kRobot_cm})),
      ball: mark('g', {class: 'ball'}, mark('circle', {r: kBall_cm})),
      predicted: timeline.predicted && timeline.predicted.x_cm !== undefined ? cross(timeline.predicted.x_cm, -goal, 14) : null,
      observed: timeline.observed && timeline.observed.x_cm !== undefined
        ? mark('circle', {class: 'observed', cx: timeline.observed.x_cm, cy: -goal, r: 16}) : null};
    const picture = mark('svg', {class: 'replay-above', viewBox: box(timeline).join(' '), role: 'img',
      'aria-label': `Kick ${timeline.kick} from above`});
    picture.append(...lines(timeline), ...Object.values(parts).filter((shown) => shown));
    return {picture, parts};
  }

  // --- from the side: y to the right, z upwards

  function side(timeline) {
    const {goal_y_cm: goal, goal_height_cm: bar, post_cm: post} = timeline.pitch;
    const ys = timeline.flight ? timeline.flight.y_cm : [];
    const zs = timeline.flight ? timeline.flight.z_cm : [];
    const heights = [timeline.predicted, timeline.observed].filter((end) => end && end.z_cm !== undefined).map((end) => end.z_cm);
    if (zs.length === 0 && heights.length === 0) return null;
    const from = Math.min(timeline.segments.s1_cm[1], ...ys) - 60;
    const to = Math.max(goal + 60, Math.min(goal + 150, Math.max(goal, ...ys)));
    const top = Math.max(bar + post + 30, ...zs, ...heights) + 30;
    const parts = {
      ballTrail: mark('path', {class: 'trail ball-trail', d: ''}),
      ball: mark('g', {class: 'ball'}, mark('circle', {r: kBall_cm})),
      predicted: timeline.predicted && timeline.predicted.z_cm !== undefined ? cross(goal, -timeline.predicted.z_cm, 12) : null,
      observed: timeline.observed && timeline.observed.z_cm !== undefined
        ? mark('circle', {class: 'observed', cx: goal, cy: -timeline.observed.z_cm, r: 14}) : null};
    const picture = mark('svg', {class: 'replay-side', viewBox: `${from} ${-top} ${to - from} ${top + 14}`, role: 'img',
      'aria-label': `Kick ${timeline.kick} from the side, with the bar of the goal`});
    picture.append(
      mark('path', {class: 'line', d: `M${from} 0H${to}`}),
      mark('path', {class: 'goal', d: `M${goal} 0V${-bar}`}),
      mark('rect', {class: 'post', x: goal - post / 2, y: -bar - post, width: post, height: post}),
      ...Object.values(parts).filter((shown) => shown));
    return {picture, parts};
  }

  // --- together

  const seconds = (t_ms) => `${t_ms < 0 ? '\u2212' : '+'}${(Math.abs(t_ms) / 1000).toFixed(2)} s`;

  function moment(timeline, t_ms) {
    const seen = timeline.observed;
    if (seen && t_ms >= (seen.t_ms ?? Infinity))
      return seen.saved === undefined ? seen.outcome.replaceAll('_', ' ') : seen.saved ? 'saved' : 'goal';
    if (t_ms >= (timeline.released_ms ?? Infinity)) return 'ball away';
    return t_ms >= 0 ? 'decided' : 'before the decision';
  }

  function put(group, place, upwards) {
    if (!group) return;
    group.setAttribute('visibility', place ? 'visible' : 'hidden');
    if (!place) return;
    const turned = place.heading === undefined ? '' : ` rotate(${-place.heading * 180 / Math.PI})`;
    group.setAttribute('transform', `translate(${upwards ? place.y : place.x} ${-(upwards ? place.z : place.y)})${turned}`);
  }

  function draw(timeline, views, t_ms) {
    const ball = ballAt(timeline, t_ms);
    const released = timeline.released_ms ?? 0;
    const {parts} = views.above;
    put(parts.robot, at(timeline.path, t_ms));
    put(parts.opponent, at(timeline.opponent, t_ms));
    put(parts.ball, ball);
    parts.trail.setAttribute('d', timeline.path ? path(timeline.path, t_ms) : '');
    parts.ballTrail.setAttribute('d', timeline.flight ? path(timeline.flight, t_ms) : '');
    parts.segments.setAttribute('class', t_ms >= 0 ? 'segments decided' : 'segments');
    if (views.side) {
      put(views.side.parts.ball, ball && t_ms >= released ? ball : null, true);
      views.side.parts.ballTrail.setAttribute('d', timeline.flight ? path(timeline.flight, t_ms, true) : '');
    }
  }

  function legend(timeline) {
    const entries = [['robot', 'robot', timeline.path], ['ball', 'ball', timeline.ball || timeline.flight],
      ['opponent', 'nearest opponent', timeline.opponent], ['other', 'opponents at the decision (the keeper square)', timeline.others_cm || timeline.keeper_x_cm !== undefined],
      ['s1', 'segment 1: along the kick', true],
      ['s2', 'segment 2: the target', true], ['predicted', 'predicted crossing', timeline.predicted],
      ['observed', 'observed crossing', timeline.observed && timeline.observed.x_cm !== undefined]];
    const list = part('ul', '', {class: 'replay-legend'});
    for (const [kind, words, there] of entries) {
      if (!there) continue;
      const entry = part('li', '');
      entry.append(part('i', '', {class: kind, 'aria-hidden': 'true'}), words);
      list.append(entry);
    }
    const missing = [[timeline.path, 'the robot\u2019s path'], [timeline.flight, 'the ball in flight'], [timeline.opponent, 'an opponent']]
      .filter(([track]) => !track).map(([, words]) => words);
    if (missing.length) list.append(part('li', `not in the log: ${missing.join(', ')}`, {class: 'missing'}));
    return list;
  }

  function controls(from, to) {
    const row = part('div', '', {class: 'replay-controls'});
    const play = part('button', 'Play', {type: 'button', class: 'replay-play'});
    const slider = part('input', '', {type: 'range', min: from, max: to, step: 10, value: 0, 'aria-label': 'Instant of the kick'});
    const speed = part('select', '', {'aria-label': 'Speed'});
    for (const [value, words] of [['0.1', 'a tenth of the speed'], ['0.25', 'a quarter'], ['0.5', 'half'], ['1', 'full speed']])
      speed.append(part('option', words, {value}));
    speed.value = '0.5';
    const place = part('output', '', {class: 'replay-time'});
    row.append(play, slider, speed, place);
    return {row, play, slider, speed, place};
  }

  return function replay(container, timeline) {
    const [from, to] = span(timeline);
    const root = part('div', '', {class: 'replay', role: 'group', 'aria-label': `Replay of kick ${timeline.kick}`});
    const views = {above: above(timeline), side: side(timeline)};
    const hands = controls(from, to);
    root.append(views.above.picture, ...(views.side ? [views.side.picture] : []), hands.row, legend(timeline));
    container.replaceChildren(root);

    let now_ms = 0;
    let playing = false;
    let frame = 0;
    let last = 0;
    const calm = matchMedia('(prefers-reduced-motion: reduce)');

    function show(t_ms) {
      now_ms = Math.min(Math.max(t_ms, from), to);
      draw(timeline, views, now_ms);
      hands.slider.value = now_ms;
      const words = `${seconds(now_ms)} ${moment(timeline, now_ms)}`;
      hands.place.textContent = words;
      hands.slider.setAttribute('aria-valuetext', words);
      root.dataset.t_ms = Math.round(now_ms);
    }
    function pause() {
      playing = false;
      cancelAnimationFrame(frame);
      hands.play.textContent = 'Play';
    }
    function tick(time) {
      const passed_ms = Math.min(250, time - last) * Number(hands.speed.value);
      if (!calm.matches || passed_ms >= kCalmStep_ms * Number(hands.speed.value)) {
        last = time;
        show(now_ms + passed_ms);
        if (now_ms >= to) return pause();
      }
      frame = requestAnimationFrame(tick);
    }
    function play() {
      if (now_ms >= to) show(from);
      playing = true;
      hands.play.textContent = 'Pause';
      last = performance.now();
      frame = requestAnimationFrame(tick);
    }
    const step = (t_ms) => { pause(); show(now_ms + t_ms); };
    const toggle = () => playing ? pause() : play();

    hands.play.addEventListener('click', toggle);
    hands.slider.addEventListener('input', () => { pause(); show(Number(hands.slider.value)); });
    root.addEventListener('keydown', (event) => {
      const own = ['BUTTON', 'SELECT'].includes(event.target.tagName);
      const keys = {' ': own ? null : toggle, ArrowLeft: () => step(-kStep_ms), ArrowRight: () => step(kStep_ms)};
      if (event.target.tagName === 'SELECT' || event.ctrlKey || event.altKey || event.metaKey || !keys[event.key]) return;
      event.preventDefault();
      event.stopPropagation();
      keys[event.key]();
    });
    show(0);
    return {pause, toggle, step, show, remove() { pause(); root.remove(); }};
  };
})();
