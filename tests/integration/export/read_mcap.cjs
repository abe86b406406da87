// Reads an MCAP file by the format's own reader and says as JSON what it holds.
const fs = require("fs");
const { McapStreamReader } = require("@mcap/core");

const reader = new McapStreamReader({ validateCrcs: true });
reader.append(fs.readFileSync(process.argv[2]));
const schemas = new Map();
const topics = {};
for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
  if (record.type === "Schema") {
    schemas.set(record.id, JSON.parse(new TextDecoder().decode(record.data)));
  } else if (record.type === "Channel") {
    topics[record.id] = { topic: record.topic, schema: schemas.get(record.schemaId), messages: 0 };
  } else if (record.type === "Message") {
    const topic = topics[record.channelId];
    const message = JSON.parse(new TextDecoder().decode(record.data));
    for (const name of Object.keys(message)) {
      if (!(name in topic.schema.properties)) throw new Error(`${topic.topic}: ${name} is not in its schema`);
    }
    topic.messages += 1;
    topic.last = message;
    topic.last_time_ns = record.logTime.toString();
  }
}
if (!reader.done()) throw new Error("the file does not end as MCAP does");
console.log(JSON.stringify(Object.values(topics)));
