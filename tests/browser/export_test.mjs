// `trivela export` read by programs from outside: MCAP by @mcap/core, its messages by Foxglove's readers of ROS 2, every
// number compared with the CSV of the same log.
import assert from 'node:assert/strict';
import {readFileSync, readdirSync} from 'node:fs';
import {createRequire} from 'node:module';
import {join} from 'node:path';
import test from 'node:test';
import {Folder, Trivela} from './processes.mjs';

const require = createRequire(join(process.env.BROWSER_FOLDER, 'package.json'));
const {McapIndexedReader, McapStreamReader} = require('@mcap/core');
const {parse} = require('@foxglove/rosmsg');
const {MessageReader, MessageWriter} = require('@foxglove/rosmsg2-serialization');
const {ros2humble} = require('@foxglove/rosmsg-msgs-common');

const folder = new Folder();
let file;  // the MCAP file's bytes

async function trivela(...args) {
  const program = new Trivela(folder, ...args);
  program.firstLine.catch(() => {});
  assert.equal(await program.end(), 0, `trivela ${args.join(' ')}: ${program.errors}`);
}

// RFC 4180; an empty cell is null, "" in quotes an empty text.
function csv(text) {
  const rows = [[]];
  for (const [, quoted, plain, end] of text.matchAll(/(?:"((?:[^"]|"")*)"|([^",\n]*))(,|\n)/g)) {
    rows.at(-1).push(quoted === undefined ? (plain === '' ? null : plain) : quoted.replaceAll('""', '"'));
    if (end === '\n') rows.push([]);
  }
  rows.pop();
  return rows;
}

const bits = (number) => Buffer.from(new Float64Array([number]).buffer).toString('hex');

// The channels of the file: definitions, and messages with their instants, read by the chunks' indexes.
async function channels() {
  const reader = await McapIndexedReader.Initialize({readable: {
    size: async () => BigInt(file.length),
    read: async (offset, size) => new Uint8Array(file.subarray(Number(offset), Number(offset + size))),
  }});
  const found = new Map();
  for (const {id, topic, schemaId, messageEncoding} of reader.channelsById.values()) {
    const schema = reader.schemasById.get(schemaId);
    assert.deepEqual([messageEncoding, schema.encoding], ['cdr', 'ros2msg']);
    const text = new TextDecoder().decode(schema.data);
    const definitions = parse(text, {ros2: true});
    found.set(id, {topic, type: schema.name, definitions, reader: new MessageReader(definitions),
      writer: new MessageWriter(definitions), messages: []});
  }
  let last = 0n;
  for await (const {channelId, logTime, data} of reader.readMessages({validateCrcs: true})) {
    assert.ok(logTime >= last, 'messages are in the order of time');
    last = logTime;
    const channel = found.get(channelId);
    const message = channel.reader.readMessage(data);
    assert.deepEqual(Buffer.from(channel.writer.writeMessage(message)), Buffer.from(data), channel.topic);
    channel.messages.push({logTime, message});
  }
  return {reader, found: [...found.values()]};
}

// A message as the cells that its row has in CSV, numbers by their bits.
function cells(message, {definitions: [{definitions}]}) {
  const members = definitions.filter(({isConstant}) => !isConstant).map(({name}) => name);
  const labels = new Map(definitions.filter(({isConstant}) => isConstant).map(({name, value}) => [name, value]));
  return members.filter((name) => !(name.startsWith('has_') && members.includes(name.slice(4)))).map((name) => {
    const value = message[name];
    if (message[`has_${name}`] === false) return null;
    if (typeof value === 'bigint') return value.toString();
    if (typeof value === 'boolean') return value ? '1' : '0';
    if (typeof value === 'string') return value;
    const {type} = definitions.find((member) => member.name === name && !member.isConstant);
    if (type === 'float64') return Number.isNaN(value) ? null : bits(value);
    const prefix = `${name.toUpperCase()}_`;
    const [label] = [...labels].find(([key, number]) => key.startsWith(prefix) && number === value);
    return label.slice(prefix.length).toLowerCase();
  });
}

test.before(async () => {
  await trivela('match', '--half', 'moving', '--half', 'predictive', '--minutes', '0.3', '--seed', '3', '--out', 'match.db');
  await trivela('export', 'match.db', '--csv', 'csv', '--mcap', 'match.mcap');
  file = readFileSync(folder.file('match.mcap'));
});
test.after(() => folder.remove());

test('a reader that goes through the file finds every CRC right and the ends in their places', () => {
  const reader = new McapStreamReader({validateCrcs: true});
  reader.append(new Uint8Array(file));
  const types = new Map();
  for (let record; (record = reader.nextRecord()) !== undefined;) {
    types.set(record.type, (types.get(record.type) ?? 0) + 1);
    if (record.type === 'DataEnd') assert.notEqual(record.dataSectionCrc, 0);
    if (record.type === 'Footer') assert.notEqual(record.summaryCrc, 0);
  }
  assert.ok(reader.done());
  assert.ok(types.get('Message') > 1000);
  assert.equal(types.get('Metadata'), 1);
});

test('every number of every stream is that of the CSV', async () => {
  const {reader, found} = await channels();
  const files = readdirSync(folder.file('csv')).map((name) => name.replace('.csv', ''));
  for (const name of files) {
    const [head, ...rows] = csv(readFileSync(folder.file(`csv/${name}.csv`), 'utf8'));
    const parts = found.filter(({topic, type}) => type.startsWith('trivela_msgs/') && topic.endsWith(`/${name}`));
    assert.ok(parts.length > 0, `${name} is in the MCAP file`);
    const [{definitions}] = parts[0].definitions;
    const isNumber = head.map((column) => definitions.find((d) => d.name === column && !d.isConstant).type === 'float64');
    const wanted = rows.map((row) => JSON.stringify(row.map((cell, i) => isNumber[i] && cell !== null ? bits(Number(cell)) : cell)));
    const got = parts.flatMap((part) => part.messages.map(({message}) => JSON.stringify(cells(message, part))));
    assert.deepEqual(got.sort(), wanted.sort(), name);
  }
  const rows = found.filter(({type}) => type.startsWith('trivela_msgs/'));
  assert.deepEqual(new Set(rows.map(({topic}) => topic.split('/').at(-1))), new Set(files));
  let messages = 0;
  for (const channel of found) messages += channel.messages.length;
  assert.equal(reader.statistics.messageCount, BigInt(messages));
});

test('standard types are those of ROS 2 Humble', async () => {
  const plain = (definitions) => definitions.filter(({isConstant}) => !isConstant)
    .map(({name, type, isArray, isComplex}) => [name, type, isArray ?? false, isComplex ?? false]);
  const {found} = await channels();
  const standard = found.filter(({type}) => !type.startsWith('trivela_msgs/'));
  assert.deepEqual([...new Set(standard.map(({type}) => type))].sort(),
    ['geometry_msgs/msg/PoseStamped', 'tf2_msgs/msg/TFMessage', 'visualization_msgs/msg/MarkerArray']);
  for (const {type, definitions} of standard) {
    const [own, ...rest] = definitions;
    for (const {name, definitions: members} of [{name: type.replace('/msg/', '/'), definitions: own.definitions}, ...rest]) {
      assert.deepEqual(plain(members), plain(ros2humble[name].definitions), name);
    }
  }
});

test('what a 3D view shows is what the rows say', async () => {
  const {found} = await channels();
  const of = (topic) => found.find((channel) => channel.topic === topic).messages;
  const states = of('/robot_1/world_states'), poses = of('/robot_1/pose'), frames = of('/tf'), balls = of('/robot_1/ball');
  assert.deepEqual([poses.length, frames.length, balls.length], [states.length, states.length, states.length]);
  states.forEach(({logTime, message: state}, i) => {
    const {header, pose} = poses[i].message;
    assert.equal(BigInt(header.stamp.sec) * 1000000000n + BigInt(header.stamp.nanosec ?? header.stamp.nsec), logTime);
    assert.deepEqual([header.frame_id, pose.position.x, pose.position.y], ['field', state.x_m, state.y_m]);
    const yaw = 2 * Math.atan2(pose.orientation.z, pose.orientation.w) - Math.PI / 2;
    assert.ok(Math.abs(Math.sin(yaw - state.heading_rad)) < 1e-12 && Math.cos(yaw - state.heading_rad) > 0);
    const [{child_frame_id: child, transform}] = frames[i].message.transforms;
    assert.deepEqual([child, transform.translation.x, transform.rotation.w], ['robot_1', state.x_m, pose.orientation.w]);
    const [ball] = balls[i].message.markers;
    assert.equal(ball.action, state.ball_known ? 0 : 2);
    if (state.ball_known) assert.deepEqual([ball.pose.position.x, ball.pose.position.y], [state.ball_x_m, state.ball_y_m]);
  });
  const decisions = of('/robot_1/kick_decisions'), alignments = of('/robot_1/alignment');
  assert.equal(alignments.length, decisions.length);
  decisions.forEach(({message: decision}, i) => {
    const [, {points: [left, right]}] = alignments[i].message.markers;
    assert.ok(Math.abs(Math.hypot(right.x - left.x, right.y - left.y) - decision.left_m - decision.right_m) < 1e-9);
  });
  const crossings = of('/robot_1/crossings').flatMap(({message}) => message.markers);
  const observed = crossings.filter(({ns, action}) => ns === 'observed' && action === 0).map(({pose}) => pose.position.z);
  assert.deepEqual(observed, of('/robot_1/kick_outcomes').map(({message}) => message.z_cross_m).filter((z) => !Number.isNaN(z)));
  assert.equal(of('/field').length, 1);
});

test('the same log makes the same bytes', async () => {
  await trivela('export', 'match.db', '--mcap', 'again.mcap');
  assert.ok(readFileSync(folder.file('again.mcap')).equals(file));
});
