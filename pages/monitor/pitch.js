// Draws the field with robots, ball and segments into an SVG. Metres of F: x to the right, y upwards.
const kRobot_m = 0.26, kBall_m = 0.13, kGoalDepth_m = 0.5, kGoalArea_m = 0.75, kPenaltyArea_m = 2.25, kMargin_m = 0.5;
const svgSpace = 'http://www.w3.org/2000/svg';

function mark(name, attributes, ...children) {
  const element = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.append(...children);
  return element;
}

function lines({goal_y: y, goal_half_width: w, side_line_x: side}) {
  const area = (depth) => [1, -1].map((end) =>
    `M${-w - depth} ${end * y}V${end * (y - depth)}H${w + depth}V${end * y}`).join('');
  const goal = (end) => mark('path', {class: 'goal', d: `M${-w} ${end * y}v${end * kGoalDepth_m}h${2 * w}v${-end * kGoalDepth_m}`});
  return [
    mark('rect', {class: 'grass', x: -side - kMargin_m, y: -y - kMargin_m - kGoalDepth_m, width: 2 * (side + kMargin_m),
      height: 2 * (y + kMargin_m + kGoalDepth_m)}),
    mark('path', {class: 'line', d: `M${-side} ${-y}H${side}V${y}H${-side}ZM${-side} 0H${side}${area(kGoalArea_m)}${area(kPenaltyArea_m)}`}),
    mark('circle', {class: 'line', cx: 0, cy: 0, r: 2}), goal(-1), goal(1)];
}

const place = (x, y) => `translate(${x.toFixed(3)} ${(-y).toFixed(3)})`;
const known = (at) => Array.isArray(at) && at.every((value) => value !== null);

function show(element, visible, attributes = {}) {
  element.setAttribute('visibility', visible ? 'visible' : 'hidden');
  if (visible) for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
}

function ends(segment) {
  const [[x1, y1], [x2, y2]] = segment;
  return {x1, y1: -y1, x2, y2: -y2};
}

export class Pitch {
  constructor(svg) {
    this.svg = svg;
    this.robots = new Map();
    this.field = '';
  }

  setField(field, simulated) {
    const now = JSON.stringify([field, simulated]);
    if (now === this.field) return;
    this.field = now;
    const {goal_y: y, side_line_x: side} = field;
    const top = -y - kMargin_m - kGoalDepth_m;
    this.svg.setAttribute('viewBox', [-side - kMargin_m, top, 2 * (side + kMargin_m), -2 * top].join(' '));
    this.layers = mark('g', {});
    this.others = mark('g', {});
    this.keeperY = y;
    this.flight = mark('circle', {class: 'flight', r: kBall_m, visibility: 'hidden'});
    this.robots.clear();
    const stamp = mark('text', {class: 'stamp', x: -side, y: y + 0.75}, 'SIMULATED');
    this.svg.replaceChildren(...lines(field), ...(simulated ? [stamp] : []), this.others, this.layers, this.flight);
  }

  partsOf(id) {
    if (this.robots.has(id)) return this.robots.get(id);
    const parts = {
      s2: mark('line', {class: 's2'}),
      s1: mark('line', {class: 's1'}),
      ball: mark('circle', {class: 'ball', r: kBall_m}),
      robot: mark('g', {class: 'robot'}, mark('circle', {class: 'ring', r: 2 * kRobot_m}), mark('circle', {class: 'body', r: kRobot_m})),
      nose: mark('path', {class: 'nose', d: `M0 0V${-1.7 * kRobot_m}`}),
      number: mark('text', {class: 'number', x: 0.66, y: 0.2}, String(id))};
    parts.robot.append(parts.nose, parts.number);
    this.layers.append(parts.s2, parts.s1, parts.robot, parts.ball);
    this.robots.set(id, parts);
    return parts;
  }

  draw(pitch) {
    if (!this.layers) return;
    for (const robot of pitch.robots) {
      const parts = this.partsOf(robot.id);
      const there = known([robot.x ?? null, robot.y ?? null, robot.heading ?? null]);
      const {segments} = robot;
      show(parts.robot, there, there && {transform: place(robot.x, robot.y),
        class: `robot${robot.fires ? ' fires' : ''}${robot.fresh ? '' : ' old'}${robot.has_ball ? ' has-ball' : ''}`});
      if (there) parts.nose.setAttribute('transform', `rotate(${-robot.heading * 180 / Math.PI})`);
      for (const [name, points] of [['s1', segments?.s1], ['s2', segments?.s2]]) {
        const drawn = points !== undefined && known(points[0]) && known(points[1]);
        show(parts[name], drawn, drawn && {...ends(points), class: `${name}${segments.meet ? ' meet' : ''}`});
      }
      show(parts.ball, known(robot.ball), known(robot.ball) && {transform: place(robot.ball[0], robot.ball[1])});
    }
    this.others.replaceChildren(...pitch.robots.flatMap(({opponents = [], keeper = null}) => [
      ...opponents.filter(known).map(([x, y]) => mark('circle', {class: 'other', cx: x, cy: -y, r: kRobot_m})),
      ...(keeper === null ? [] : [mark('rect', {class: 'other keeper', x: keeper - kRobot_m, y: -this.keeperY - kRobot_m,
        width: 2 * kRobot_m, height: 2 * kRobot_m})])]));
    const flying = known(pitch.flight);
    show(this.flight, flying, flying && {transform: place(pitch.flight[0], pitch.flight[1]),
      r: (kBall_m * (1 + 0.6 * Math.max(0, Math.min(pitch.flight[2], 3)))).toFixed(3)});
  }
}
