// A USB host at the board's plug, for the emulator of the board: it resets the bus, asks for all descriptors, opens the
// serial line and exchanges its bytes.
//
// The package rp2040js transfers each packet at once, whatever its buffer says. Here the controller is as the RP2040's
// datasheet has it (chapter 4.1): a packet moves only if its endpoint's buffer is available, both buffers of an endpoint
// take turns, packets are DATA0 and DATA1 in turn, and a transaction takes its time on the bus. What a host would not
// accept ends the emulator with an error.
export const MHZ = 200; // the processor's
const BUS_BYTE_CYCLES = (8 * MHZ) / 12; // 12 Mbit/s
const OVERHEAD_BYTES = 13; // of a transaction: tokens, checksums, pauses
const PACKET = 64;
const PAUSE_CYCLES = 32 * MHZ; // when a device has nothing to send; hosts ask more often, which costs the emulator too much
const MOST_REFUSALS = 2000; // of a control request, before the host gives up

const [FULL, SECOND_KIND, FIRST_BUFFER, STALL, AVAILABLE, LENGTH] = [1 << 15, 1 << 13, 1 << 12, 1 << 11, 1 << 10, 0x3ff];
const [ENABLED, TWO_BUFFERS] = [2 ** 31, 2 ** 30];
const [BUS_RESET, HAS_SETUP] = [1 << 19, 1 << 17];
const PULL_UP = 1 << 16;

function check(is, text) {
  if (!is) throw new Error(`the USB host: ${text}`);
}

/** The controller's side of the bus. */
class Controller {
  #turn = new Map(); // the buffer that is next, by the address of its control word

  constructor(chip) {
    this.usb = chip.usbCtrl;
    this.memory = chip.usbDPRAM;
    this.words = chip.usbDPRAMView;
    this.usb.DPRAMUpdated = () => {};
  }

  get isConnected() {
    return (this.usb.sieCtrl & PULL_UP) !== 0 && (this.usb.mainCtrl & 1) !== 0;
  }

  reset() {
    this.#turn.clear();
    this.usb.sieStatus |= BUS_RESET;
  }

  setup(address, bytes) {
    this.#expectAddress(address);
    for (const at of [0x80, 0x84]) this.words.setUint32(at, this.words.getUint32(at, true) & ~STALL, true);
    this.memory.set(bytes, 0);
    this.usb.sieStatus |= HAS_SETUP;
  }

  /** The host asks for a packet. Returns its bytes, or 'wait' or 'stall'. */
  in(address, endpoint, isSecondKind) {
    return this.#transfer(address, endpoint, 0x80, isSecondKind, (half, at) => {
      check((half & FULL) !== 0, `endpoint ${endpoint} sends an empty buffer`);
      return [half & ~FULL, this.memory.slice(at, at + (half & LENGTH))];
    });
  }

  /** The host sends a packet. Returns [], or 'wait' or 'stall'. */
  out(address, endpoint, isSecondKind, bytes) {
    return this.#transfer(address, endpoint, 0x84, isSecondKind, (half, at) => {
      check(bytes.length <= (half & LENGTH), `endpoint ${endpoint} has room for ${half & LENGTH} bytes`);
      this.memory.set(bytes, at);
      return [(half & ~LENGTH) | FULL | bytes.length, []];
    });
  }

  #transfer(address, endpoint, base, isSecondKind, move) {
    this.#expectAddress(address);
    const isOut = base === 0x84;
    const word = base + 8 * endpoint;
    const control = endpoint === 0 ? 0 : this.words.getUint32(8 * endpoint + (isOut ? 4 : 0), true);
    check(endpoint === 0 || control >= ENABLED, `endpoint ${endpoint} is not there`);
    if ((this.words.getUint16(word, true) & FIRST_BUFFER) !== 0) this.#turn.set(word, 0);
    const turn = this.#turn.get(word) ?? 0;
    const half = this.words.getUint16(word + 2 * turn, true);
    if ((half & STALL) !== 0) return 'stall';
    if ((half & AVAILABLE) === 0) return 'wait';
    check(((half & SECOND_KIND) !== 0) === isSecondKind, `endpoint ${endpoint}: a packet of the wrong kind`);
    const [after, bytes] = move(half, (endpoint === 0 ? 0x100 : control & 0xffc0) + PACKET * turn);
    this.words.setUint16(word + 2 * turn, after & ~AVAILABLE & ~FIRST_BUFFER, true);
    if ((control & TWO_BUFFERS) !== 0) this.#turn.set(word, turn ^ 1);
    this.usb.buffStatus |= 1 << (2 * endpoint + (isOut ? 1 : 0));
    return bytes;
  }

  #expectAddress(address) {
    check((this.usb.addrEndp & 0x7f) === address, `the device has address ${this.usb.addrEndp & 0x7f}, not ${address}`);
  }
}

export class UsbHost {
  due = Infinity; // the cycle of its next transaction
  received = [];
  waiting = []; // bytes to send
  texts = []; // maker, name, serial number
  isOpen = false;
  #address = 0;
  #kinds = { in: false, out: false }; // of the line's next packets
  #work = null;

  constructor(chip) {
    this.controller = new Controller(chip);
  }

  plug(now) {
    this.#begin(now);
  }

  unplug() {
    this.due = Infinity;
    this.isOpen = false;
    this.waiting = [];
  }

  /** The host resets the bus and begins anew, as it does after an error. */
  reset(now) {
    this.#begin(now);
  }

  /** Closes the line, with this speed set before. */
  close(now, speed) {
    this.#work = this.#closing(speed);
    this.due = now;
  }

  step() {
    this.due += this.#work.next().value ?? Infinity;
  }

  #begin(now) {
    this.#work = this.#session();
    this.isOpen = false;
    this.due = now;
  }

  * #session() {
    while (!this.controller.isConnected) yield 1000 * MHZ;
    yield* this.#resetBus();
    check((yield* this.#read(0x80, 6, 0x100, 0, 64)).length === 18, 'a device descriptor of another length');
    yield* this.#resetBus(); // as Linux does
    yield* this.#write(0, 5, 7, 0);
    yield 2000 * MHZ;
    this.#address = 7;
    yield* this.#describe();
    yield* this.#write(0, 9, 1, 0);
    this.#kinds = { in: false, out: false };
    check((yield* this.#read(0x80, 8, 0, 0, 1))[0] === 1, 'the device is not configured');
    yield* this.#open();
    yield* this.#exchange();
  }

  * #describe() {
    const device = yield* this.#read(0x80, 6, 0x100, 0, 18);
    check(device[0] === 18 && device[7] === PACKET && device[17] === 1, 'a strange device descriptor');
    const head = yield* this.#read(0x80, 6, 0x200, 0, 9);
    const size = head[2] | (head[3] << 8);
    const whole = yield* this.#read(0x80, 6, 0x200, 0, 255);
    check(whole.length === size, `a configuration of ${whole.length} bytes says ${size}`);
    const kinds = [];
    for (let at = 0; at < whole.length; at += whole[at]) kinds.push(whole[at + 1]);
    check(String(kinds) === '2,4,36,36,36,36,5,4,5,5', `descriptors ${kinds}`);
    check((yield* this.#read(0x80, 6, 0x600, 0, 10)) === null, 'a device of full speed has no qualifier');
    check((yield* this.#read(0x80, 6, 0x300, 0, 255)).length === 4, 'no language');
    this.texts = [];
    for (let n = 1; n <= 3; ++n) {
      const text = yield* this.#read(0x80, 6, 0x300 | n, 0x409, 255);
      check(text[0] === text.length, `text ${n}`);
      this.texts.push(Buffer.from(text.slice(2)).toString('utf16le'));
    }
  }

  * #open() {
    yield* this.#setSpeed(1000000);
    const coding = yield* this.#read(0xa1, 0x21, 0, 0, 7);
    check(Buffer.from(coding).readUInt32LE(0) === 1000000, 'the speed was not kept');
    yield* this.#write(0x21, 0x22, 3, 0);
    this.isOpen = true;
  }

  * #closing(speed) {
    yield* this.#setSpeed(speed);
    yield* this.#write(0x21, 0x22, 0, 0);
    this.isOpen = false;
    yield Infinity;
  }

  * #setSpeed(speed) {
    const coding = Buffer.from([0, 0, 0, 0, 0, 0, 8]);
    coding.writeUInt32LE(speed, 0);
    yield* this.#write(0x21, 0x20, 0, 0, coding);
  }

  /** Both ways in turn, as often as the bus permits. */
  * #exchange() {
    for (;;) {
      const packet = this.waiting.slice(0, PACKET);
      if (packet.length > 0) {
        const took = this.controller.out(this.#address, 2, this.#kinds.out, packet);
        if (took !== 'wait') {
          this.waiting.splice(0, packet.length);
          this.#kinds.out = !this.#kinds.out;
        }
        yield this.#cyclesOf(packet.length);
      }
      const got = this.controller.in(this.#address, 2, this.#kinds.in);
      if (got !== 'wait') {
        this.received.push(...got);
        this.#kinds.in = !this.#kinds.in;
      }
      yield got === 'wait' ? PAUSE_CYCLES : this.#cyclesOf(got.length);
    }
  }

  * #resetBus() {
    this.#address = 0;
    this.controller.reset();
    yield 10000 * MHZ;
  }

  /** A control request that reads. Returns its bytes, or null if the device refuses it. */
  * #read(type, request, value, index, length) {
    yield* this.#setup([type, request, value & 255, value >> 8, index & 255, index >> 8, length & 255, length >> 8]);
    const bytes = [];
    for (let isSecondKind = true; ; isSecondKind = !isSecondKind) {
      const got = yield* this.#control(() => this.controller.in(this.#address, 0, isSecondKind));
      if (got === 'stall') return null;
      bytes.push(...got);
      if (got.length < PACKET || bytes.length === length) break;
    }
    check(bytes.length <= length, 'more bytes than were asked for');
    yield* this.#control(() => this.controller.out(this.#address, 0, true, []));
    return bytes;
  }

  * #write(type, request, value, index, bytes = []) {
    const { length } = bytes;
    yield* this.#setup([type, request, value & 255, value >> 8, index & 255, index >> 8, length & 255, length >> 8]);
    if (length > 0) yield* this.#control(() => this.controller.out(this.#address, 0, true, bytes));
    const end = yield* this.#control(() => this.controller.in(this.#address, 0, true));
    check(end.length === 0 && end !== 'stall', `request ${request} was refused`);
  }

  * #setup(bytes) {
    this.controller.setup(this.#address, bytes);
    yield this.#cyclesOf(8);
  }

  * #control(transact) {
    for (let left = MOST_REFUSALS; left > 0; --left) {
      const done = transact();
      yield this.#cyclesOf(done === 'wait' || done === 'stall' ? 0 : done.length);
      if (done !== 'wait') return done;
    }
    throw new Error('the USB host: a control request is not answered');
  }

  #cyclesOf(bytes) {
    return Math.ceil((OVERHEAD_BYTES + bytes) * BUS_BYTE_CYCLES);
  }
}
