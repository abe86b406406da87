// CNCjs without a window, driven as its page drives it: connects, homes, runs a program with a hold and an override, resets in
// the middle, and connects again.
// Usage: node cncjs_sender.cjs TERMINAL PROGRAM FOLDER
'use strict';

const {spawn} = require('child_process');
const fs = require('fs');
const net = require('net');
const path = require('path');
const io = require('socket.io-client');
const jwt = require('jsonwebtoken');

const [terminal, programFile, folder] = process.argv.slice(2);
const secret = 'a secret of this test';
const program = fs.readFileSync(programFile, 'utf8');
const seen = {state: '', position: [], override: [], sender: {}, workflow: '', text: ''};

const sleep = (ms) => new Promise((done) => setTimeout(done, ms));
function check(holds, what) {
  if (!holds) throw new Error(`${what}: ${JSON.stringify({...seen, text: seen.text.slice(-2000)})}`);
}
async function until(holds, what, seconds = 60) {
  const end = Date.now() + seconds * 1000;
  while (!holds()) {
    check(Date.now() < end, `not within ${seconds} s: ${what}`);
    await sleep(20);
  }
}
async function freePort() {
  const server = net.createServer();
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  const {port} = server.address();
  await new Promise((done) => server.close(done));
  return port;
}
async function serverListens(port) {
  return new Promise((done) => {
    const probe = net.connect(port, '127.0.0.1', () => { probe.destroy(); done(true); });
    probe.on('error', () => done(false));
  });
}

async function start() {
  const port = await freePort();
  const config = path.join(folder, 'cncrc');
  fs.writeFileSync(config, JSON.stringify({secret, checkForUpdates: false}));
  const bin = path.join(path.dirname(require.resolve('cncjs/package.json')), 'bin', 'cncjs');
  const server = spawn(process.execPath, [bin, '--port', `${port}`, '--host', '127.0.0.1', '--config', config],
    {stdio: ['ignore', fs.openSync(path.join(folder, 'cncjs.log'), 'w'), 'inherit'], env: {...process.env, HOME: folder}});
  process.on('exit', () => server.kill('SIGKILL'));
  for (let tries = 0; !(await serverListens(port)); ++tries) {
    check(tries < 600 && server.exitCode === null, 'CNCjs does not listen');
    await sleep(100);
  }
  const token = jwt.sign({id: '', name: ''}, secret);
  return io.connect(`http://127.0.0.1:${port}`, {query: `token=${token}`, transports: ['websocket']});
}

function listen(socket) {
  socket.on('error', (error) => { seen.text += `socket: ${JSON.stringify(error)}\n`; });
  socket.on('controller:state', (_, {status = {}}) => {
    seen.state = status.activeState || seen.state;
    if (status.mpos) seen.position = ['x', 'y', 'z'].map((axis) => Number(status.mpos[axis]));
    if (status.ov) seen.override = status.ov.map(Number);
  });
  socket.on('sender:status', (status) => { seen.sender = status; });
  socket.on('workflow:state', (state) => { seen.workflow = state; });
  socket.on('serialport:read', (line) => { seen.text += `${line}\n`; });
}
async function open(socket) {
  await until(() => socket.connected, 'a connection to CNCjs');
  const options = {controllerType: 'Grbl', baudrate: 115200, rtscts: false};
  const error = await new Promise((done) => socket.emit('open', terminal, options, done));
  check(!error, `the terminal is opened: ${error}`);
}

async function main() {
  const socket = await start();
  listen(socket);
  const command = (...words) => socket.emit('command', terminal, ...words);
  const stands = (...place) => place.every((mm, axis) => Math.abs(seen.position[axis] - mm) < 0.02);
  const runs = async (text) => {
    const error = await new Promise((done) => command('gcode:load', 'program', text, {}, done));
    check(!error, `the program is loaded: ${error}`);
    command('gcode:start');
    await until(() => seen.workflow === 'running', 'the program runs');
  };
  const ends = (seconds) =>
    until(() => seen.workflow === 'idle' && seen.sender.received === seen.sender.total && seen.state === 'Idle', 'its end', seconds);

  await open(socket);
  await until(() => seen.state === 'Alarm', 'an unhomed machine');
  command('homing');
  await until(() => seen.state === 'Idle', 'a homed machine', 120);
  console.log('homed at', seen.position.join(' '));

  const begun = Date.now();
  await runs(program);
  await until(() => seen.sender.received > 1200, '1,200 lines');
  command('gcode:pause');
  await until(() => seen.state === 'Hold', 'a hold');
  await sleep(1000);
  const held = [...seen.position];
  await sleep(500);
  check(stands(...held), 'it stands');
  command('feedOverride', 10);
  await until(() => seen.override[0] === 110, 'an override of 110 %');
  command('gcode:resume');
  await until(() => seen.state === 'Run', 'motion behind the hold');
  await ends(240);
  command('feedOverride', 0);
  check(stands(20, 60, 40), 'the program\'s end');
  check(seen.sender.total > 4900, 'all lines');
  console.log(`${seen.sender.total} lines in ${(Date.now() - begun) / 1000} s`);

  await runs(program);
  await until(() => seen.sender.received > 800 && seen.sender.received < 2500, '800 lines');
  command('reset');
  await until(() => seen.workflow === 'idle' && seen.state === 'Idle', 'rest behind a reset');
  check(!stands(20, 60, 40) && !seen.text.includes('ALARM'), 'a rest in the middle, and no alarm');
  console.log('reset at', seen.position.join(' '));

  await new Promise((done) => socket.emit('close', terminal, done));
  seen.state = '';
  await sleep(500);
  await open(socket);
  await until(() => seen.state === 'Idle', 'a machine that is still homed');
  await runs('G90 G0 X20 Y20\nG4 P0.1\nM30\n');
  await ends(60);
  check(stands(20, 20), 'the last program\'s end');
  check(!/error|ALARM/.test(seen.text), 'no error');
  await new Promise((done) => socket.emit('close', terminal, done));
  console.log('connected again, and ended at', seen.position.join(' '));
}

main().then(() => process.exit(0), (error) => { console.error(error.message); process.exit(1); });
