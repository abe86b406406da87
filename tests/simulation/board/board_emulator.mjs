// A Raspberry Pi Pico that runs a firmware in virtual time, for another process at the other end of its line. One process
// runs one board after another, so that Node compiles the emulator's code only once.
//
// Usage: node board_emulator.mjs FIRMWARE.uf2
//
// Request, on standard input, little-endian, of u32: the microsecond until which to run (0: another board, just powered
// up, takes the place of the last one), the levels of the input pins (pin
// n is bit n), what happens at the USB plug (PLUG), how many bytes arrive at the board from now on by its UART and by USB,
// these bytes. Answer: how many bytes the board has sent by its UART and by USB, how many edges its pins had, for how many
// cycles the processor was in interrupts, what the board is (STATE), the bytes, the edges: processor cycle (f64), pin (u8),
// level (u8). An end of input ends the process. The start of the machines that time the
// motors' pins is an edge of pin 255.
//
// The package rp2040js runs the chip's programmable machines (PIO) from a JavaScript timer, without dividers. Here they
// run in step with the processor. It also lets a UART send without end; here a byte takes its time.
import fs from 'node:fs';
import { FIFO, GPIOPinState, RP2040 } from 'rp2040js';
import { attachFlashId, FLASH_ID } from './flash_id.mjs';
import { MHZ, UsbHost } from './usb_host.mjs';

const VOLTAGE_FOR_IT = 0xc1; // 1.15 V
const NS_PER_CYCLE = 1000 / MHZ;
const BYTE_CYCLES = 10 * MHZ; // 1 MBd, with a start and a stop bit
const UART_QUEUE = 32;
const TRANSMIT_FULL = 1 << 5;
const START = 255;
const PLUG = { none: 0, in: 1, out: 2, reset: 3, closeAt1200: 4 };
const STATE = { isOpen: 1, isInBootMode: 2 }; // a program on the USB host has the line open; the firmware has ended
// Of a boot ROM: its function that finds others, of which there is one, and that other one, which ends the firmware. Half
// words at their addresses.
const ROM = [[0x14, 0x40], [0x18, 0x21], [0x20, 0x4800], [0x22, 0x4770], [0x24, 0x31], [0x26, 0], [0x30, 0xbe00],
  [0x32, 0xe7fe]];
const ROM_END = 0x30;
const TEXTS = `Lockstep,Motor board,${Buffer.from(FLASH_ID).toString('hex').toUpperCase()}`;
const WATCHED_PINS = [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 22, 25, 26, 27, 28];
const INPUT_PINS = [13, 14, 15, 16, 17, 18, 19, 20, 21];
const STACK_OF_BOOT_ROM = 0x20041f00;
const SECOND_STAGE = 0x10000000;

/** A machine of the PIO, and the cycle of its next instruction. */
class ClockedMachine {
  constructor(machine) {
    this.machine = machine;
    this.due = Infinity;
  }

  followEnabled(now) {
    if (this.machine.enabled === (this.due !== Infinity)) return;
    this.due = this.machine.enabled ? now : Infinity;
  }

  step() {
    const before = this.machine.cycles;
    this.machine.step();
    this.due += this.machine.clockDivInt * Math.max(1, this.machine.cycles - before);
  }
}

class Board {
  now = 0; // processor cycles since power-up
  sent = [];
  edges = [];
  interrupted = 0; // cycles
  #arriving = [];
  #nextArrival = Infinity;
  #leaving = 0; // the cycle at which the UART's queue is empty
  #nextDue = Infinity; // the cycle of the next instruction of a machine
  #edgeTime = null; // of the PIO instruction in progress

  constructor(uf2) {
    this.chip = new RP2040();
    const fail = (part, text) => { throw new Error(`${part}: ${text}`); };
    this.chip.logger = { debug() {}, info() {}, warn: fail, error: fail };
    this.chip.onBreak = () => this.#end();
    this.#load(uf2);
    this.#makeRandomBits();
    this.#clockMachines();
    this.#connectUart();
    this.#watchPins();
    this.#watchVoltage();
    attachFlashId(this.chip);
    for (const [at, half] of ROM) this.chip.bootrom[at >> 2] |= half << (8 * (at & 2));
    this.usb = new UsbHost(this.chip);
    this.chip.core.SP = STACK_OF_BOOT_ROM;
    this.chip.core.PC = SECOND_STAGE;
  }

  #end() {
    const { PC, registers } = this.chip.core;
    if (PC < ROM_END || PC > ROM_END + 4) throw new Error(`the firmware stopped at ${this.now / MHZ} us`);
    if (registers[0] !== 0 || registers[1] !== 0) throw new Error('the boot mode is asked for with pins or without a drive');
    this.isInBootMode = true;
    this.chip.core.waiting = true;
  }

  #load(uf2) {
    for (let at = 0; at < uf2.length; at += 512) {
      const address = uf2.readUInt32LE(at + 12);
      this.chip.flash.set(uf2.subarray(at + 32, at + 32 + uf2.readUInt32LE(at + 16)), address - SECOND_STAGE);
    }
  }

  /** The ring oscillator's, which the package does not have: the same in each run. */
  #makeRandomBits() {
    let drawn = 0;
    this.chip.peripherals[0x40060].readUint32 = () => Math.imul(++drawn, 0x9e3779b1) >>> 31;
  }

  /** The package has no regulator. The system's clock may change its source (0x3c) only with a core voltage for it. */
  #watchVoltage() {
    let voltage = 0;
    this.chip.peripherals[0x40064].writeUint32 = (offset, value) => { if (offset === 0) voltage = value; };
    const clocks = this.chip.peripherals[0x40008];
    const write = clocks.writeUint32.bind(clocks);
    clocks.writeUint32 = (offset, value) => {
      if (offset === 0x3c && voltage !== VOLTAGE_FOR_IT) throw new Error('the core voltage is too low for the clock');
      write(offset, value);
    };
  }

  #clockMachines() {
    this.machines = [];
    for (const pio of this.chip.pio) {
      pio.run = () => {};
      for (const machine of pio.machines) {
        machine.clkDivRestart = () => {}; // a divider begins with its machine
        machine.txFIFO = new FIFO(8); // the firmware joins both queues of a machine
        this.machines.push(new ClockedMachine(machine));
      }
      const write = pio.writeUint32.bind(pio);
      pio.writeUint32 = (offset, value) => {
        write(offset, value);
        if (offset !== 0) return;
        for (const one of this.machines) one.followEnabled(this.now);
        if (pio === this.chip.pio[0]) this.edges.push([this.now, START, 1]);
        this.#nextDue = this.#nextInstruction();
      };
    }
  }

  #connectUart() {
    const uart = this.chip.uart[0];
    uart.onByte = (byte) => {
      this.sent.push(byte);
      this.#leaving = Math.max(this.#leaving, this.now) + BYTE_CYCLES;
    };
    const read = uart.readUint32.bind(uart);
    const isFull = () => this.#leaving - this.now > UART_QUEUE * BYTE_CYCLES;
    uart.readUint32 = (offset) => (offset === 0x18 && isFull() ? read(offset) | TRANSMIT_FULL : read(offset));
  }

  #watchPins() {
    for (const pin of WATCHED_PINS) {
      let level = 0;
      this.chip.gpio[pin].addListener((state) => {
        const now = state === GPIOPinState.High ? 1 : 0;
        if (now !== level) this.edges.push([this.#edgeTime ?? this.now, pin, now]);
        level = now;
      });
    }
  }

  setInputs(levels) {
    for (const pin of INPUT_PINS) this.chip.gpio[pin].setInputValue((levels >>> pin & 1) === 1);
  }

  receive(bytes) {
    if (this.#arriving.length === 0 && bytes.length > 0) this.#nextArrival = this.now + BYTE_CYCLES;
    this.#arriving.push(...bytes);
  }

  plug(event, bytes) {
    if (event === PLUG.in) this.usb.plug(this.now);
    if (event === PLUG.out) this.usb.unplug();
    if (event === PLUG.reset) this.usb.reset(this.now);
    if (event === PLUG.closeAt1200) this.usb.close(this.now, 1200);
    if (this.usb.isOpen) this.usb.waiting.push(...bytes);
  }

  run(untilUs) {
    const { chip } = this;
    const until = untilUs * MHZ;
    while (this.now < until) {
      const cycles = chip.core.waiting ? this.#cyclesToWake(until) : chip.core.executeInstruction();
      this.now += cycles;
      if (chip.core.IPSR !== 0) this.interrupted += cycles;
      chip.clock.tick(cycles * NS_PER_CYCLE);
      if (this.#nextDue < this.now) this.#runMachines();
      if (this.#nextArrival <= this.now) this.#arrive();
      if (this.usb.due <= this.now) this.usb.step();
    }
    if (this.usb.isOpen && String(this.usb.texts) !== TEXTS) throw new Error(`the USB device is ${this.usb.texts}`);
  }

  #nextInstruction() {
    let next = Infinity;
    for (const one of this.machines) if (one.due < next) next = one.due;
    return next;
  }

  #cyclesToWake(until) {
    const alarm = Math.ceil(this.chip.clock.nanosToNextAlarm / NS_PER_CYCLE) || Infinity;
    const others = Math.min(until, this.#nextDue, this.#nextArrival, Math.ceil(this.usb.due)) - this.now;
    return Math.max(1, Math.min(alarm, others));
  }

  #runMachines() {
    while (this.#nextDue < this.now) {
      this.#edgeTime = this.#nextDue;
      for (const one of this.machines) if (one.due === this.#nextDue) one.step();
      for (const pio of this.chip.pio) pio.checkChangedPins();
      this.#nextDue = this.#nextInstruction();
    }
    this.#edgeTime = null;
  }

  #arrive() {
    this.chip.uart[0].feedByte(this.#arriving.shift());
    this.#nextArrival = this.#arriving.length > 0 ? this.#nextArrival + BYTE_CYCLES : Infinity;
  }

  #state() {
    return (this.usb.isOpen ? STATE.isOpen : 0) | (this.isInBootMode ? STATE.isInBootMode : 0);
  }

  take() {
    const { sent, edges, usb } = this;
    const head = 20;
    const answer = Buffer.alloc(head + sent.length + usb.received.length + 10 * edges.length);
    [sent.length, usb.received.length, edges.length, this.interrupted, this.#state()].forEach((word, n) => {
      answer.writeUInt32LE(word, 4 * n);
    });
    answer.set(sent, head);
    answer.set(usb.received, head + sent.length);
    let at = head + sent.length + usb.received.length;
    for (const [cycle, pin, level] of edges) {
      answer.writeDoubleLE(cycle, at);
      answer[at + 8] = pin;
      answer[at + 9] = level;
      at += 10;
    }
    this.sent = [];
    this.edges = [];
    this.usb.received = [];
    this.interrupted = 0;
    return answer;
  }
}

/** Reads exactly so many bytes of standard input; null at its end. */
function read(size) {
  const bytes = Buffer.alloc(size);
  for (let at = 0; at < size;) {
    const got = fs.readSync(0, bytes, at, size - at);
    if (got === 0) return null;
    at += got;
  }
  return bytes;
}

function write(bytes) {
  for (let at = 0; at < bytes.length;) at += fs.writeSync(1, bytes, at);
}

const firmware = fs.readFileSync(process.argv[2]);
let board = null;
for (let request = read(20); request !== null; request = read(20)) {
  const [until, levels, plug, uartBytes, usbBytes] = Array.from({ length: 5 }, (_, n) => request.readUInt32LE(4 * n));
  if (until === 0) board = new Board(firmware);
  board.setInputs(levels);
  board.receive(read(uartBytes));
  board.plug(plug, read(usbBytes));
  board.run(until);
  write(board.take());
}
