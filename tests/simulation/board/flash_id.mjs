// The line to the flash, as far as the firmware uses it: the flash answers the command that asks for its number, and
// nothing else. The package rp2040js answers each byte with 0.
export const FLASH_ID = [0xe6, 0x61, 0x38, 0x52, 0x83, 0x4c, 0x1b, 0x2f];

const [ENABLE, STATUS, DATA] = [0x08, 0x28, 0x60];
const READ_ID = 0x4b;
const HAS_RECEIVED = 1 << 3;

/** The bytes that come for those that were sent since the flash was selected. */
function answerTo(sent) {
  const isAsked = sent[0] === READ_ID && sent.length > 5;
  return isAsked ? FLASH_ID[sent.length - 6] ?? 0xff : 0xff;
}

export function attachFlashId(chip) {
  const line = chip.peripherals[0x18000];
  const [read, write] = [line.readUint32.bind(line), line.writeUint32.bind(line)];
  let sent = [];
  let answers = [];
  line.writeUint32 = (offset, value) => {
    if (offset === ENABLE) [sent, answers] = [[], []];
    if (offset !== DATA) return write(offset, value);
    sent.push(value & 0xff);
    answers.push(answerTo(sent));
  };
  line.readUint32 = (offset) => {
    if (offset === STATUS) return answers.length > 0 ? HAS_RECEIVED : 0;
    return offset === DATA ? answers.shift() ?? 0 : read(offset);
  };
}
