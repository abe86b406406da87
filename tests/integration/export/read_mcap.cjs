// Reads an MCAP file with the format's own readers and prints its content as JSON: as a stream, and by its index, as
// Foxglove and PlotJuggler do. Both must find the same messages. Checks the registry's rules for JSON: the names of the
// encodings, schemas of objects, and messages that match their schemas.
const fs = require("fs");
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");

const path = process.argv[2];
const isOfType = { integer: Number.isInteger, number: Number.isFinite, string: (value) => typeof value === "string" };
function demand(holds, what) {
  if (!holds) throw new Error(what);
}
const textOf = (bytes) => new TextDecoder().decode(bytes);
const keyOf = (message) => `${message.channelId} ${message.sequence} ${message.logTime} ${textOf(message.data)}`;
const sameMessages = (some, others) => {
  const keys = some.map(keyOf).sort();
  return keys.length === others.length && others.map(keyOf).sort().every((key, i) => key === keys[i]);
};

function readStream() {
  const reader = new McapStreamReader({ validateCrcs: true });
  reader.append(fs.readFileSync(path));
  const schemas = new Map();
  const topics = {};
  const messages = [];
  for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
    if (record.type === "Schema") {
      const schema = JSON.parse(textOf(record.data));
      demand(record.encoding === "jsonschema" && schema.type === "object", `${record.name}: no schema of JSON objects`);
      schemas.set(record.id, schema);
    } else if (record.type === "Channel") {
      demand(record.messageEncoding === "json", `${record.topic}: its messages are not declared as JSON`);
      topics[record.id] ??= { topic: record.topic, schema: schemas.get(record.schemaId), messages: 0 };
    } else if (record.type === "Message") {
      const topic = topics[record.channelId];
      const message = JSON.parse(textOf(record.data));
      for (const [name, value] of Object.entries(message)) {
        const type = topic.schema.properties[name]?.type;
        demand(type in isOfType && isOfType[type](value), `${topic.topic}: ${name} is ${value}, its schema has ${type}`);
      }
      messages.push({ ...record, data: Uint8Array.from(record.data) });
      topic.messages += 1;
      topic.last = message;
      topic.last_time_ns = record.logTime.toString();
    }
  }
  demand(reader.done(), "the file does not end as MCAP does");
  return { topics, messages };
}

// Counts the bytes that the reader asks for.
class CountedFile {
  file = fs.openSync(path);
  bytes = 0;
  async size() {
    return BigInt(fs.fstatSync(this.file).size);
  }
  async read(offset, length) {
    const buffer = Buffer.alloc(Number(length));
    demand(fs.readSync(this.file, buffer, 0, buffer.length, Number(offset)) === buffer.length, "a read beyond the end");
    this.bytes += buffer.length;
    return buffer;
  }
}

async function read(indexed, query) {
  const messages = [];
  for await (const message of indexed.readMessages(query)) messages.push({ ...message, data: Uint8Array.from(message.data) });
  return messages;
}

const isRising = (messages) => messages.every((message, i) => i === 0 || messages[i - 1].logTime <= message.logTime);

function checkSummary(indexed, stream) {
  const times = stream.messages.map((message) => message.logTime);
  const least = times.reduce((a, b) => (a < b ? a : b));
  const most = times.reduce((a, b) => (a > b ? a : b));
  const { statistics, channelsById, schemasById, chunkIndexes } = indexed;
  demand(statistics.messageCount === BigInt(times.length), "another number of messages in the statistics");
  demand(statistics.messageStartTime === least && statistics.messageEndTime === most, "other times in the statistics");
  demand(statistics.chunkCount === chunkIndexes.length, "another number of chunks in the statistics");
  demand(statistics.schemaCount === schemasById.size, "another number of schemas in the statistics");
  demand(statistics.channelCount === channelsById.size, "another number of channels in the statistics");
  for (const [id, topic] of Object.entries(stream.topics)) {
    const channel = channelsById.get(Number(id));
    demand(channel.topic === topic.topic && schemasById.has(channel.schemaId), `${topic.topic}: not in the summary`);
    demand(statistics.channelMessageCounts.get(Number(id)) === BigInt(topic.messages), `${topic.topic}: another count`);
  }
}

async function checkReads(indexed, file, stream) {
  const all = await read(indexed, {});
  demand(isRising(all) && sameMessages(all, stream.messages), "the index leads to other messages than the stream has");
  const back = await read(indexed, { reverse: true });
  demand(isRising(back.reverse()) && sameMessages(back, all), "backwards, the index leads to other messages");
  for (const [id, topic] of Object.entries(stream.topics)) {
    const found = await read(indexed, { topics: [topic.topic] });
    const expected = stream.messages.filter((message) => message.channelId === Number(id));
    demand(isRising(found) && sameMessages(found, expected), `${topic.topic}: not found by its topic`);
  }
  const begin = all[0].logTime;
  const lasts = all[all.length - 1].logTime - begin;
  for (let part = 0n; part < 10n; part += 1n) {
    const [startTime, endTime] = [begin + (lasts * part) / 10n, begin + (lasts * (part + 1n)) / 10n];
    const found = await read(indexed, { startTime, endTime });
    const expected = stream.messages.filter(({ logTime }) => startTime <= logTime && logTime <= endTime);
    demand(expected.length > 0 && isRising(found) && sameMessages(found, expected), `part ${part}: not found by its time`);
  }
  file.bytes = 0;
  const instant = await read(indexed, { startTime: begin, endTime: begin });
  demand(instant.length > 0, "the first message is not found by its time");
  return file.bytes;
}

async function main() {
  const stream = readStream();
  const file = new CountedFile();
  const indexed = await McapIndexedReader.Initialize({ readable: file });
  checkSummary(indexed, stream);
  const bytesOfOneInstant = await checkReads(indexed, file, stream);
  const { chunkIndexes } = indexed;
  console.log(JSON.stringify({ topics: Object.values(stream.topics), chunks: chunkIndexes.length, bytesOfOneInstant }));
}

main();
