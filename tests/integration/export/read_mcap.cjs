// Reads an MCAP file with the format's own reader and prints its content as JSON. Checks the registry's rules for JSON:
// the names of the encodings, schemas of objects, and messages that match their schemas.
const fs = require("fs");
const { McapStreamReader } = require("@mcap/core");

const reader = new McapStreamReader({ validateCrcs: true });
reader.append(fs.readFileSync(process.argv[2]));
const isOfType = { integer: Number.isInteger, number: Number.isFinite, string: (value) => typeof value === "string" };
function demand(holds, what) {
  if (!holds) throw new Error(what);
}
const schemas = new Map();
const topics = {};
for (let record = reader.nextRecord(); record; record = reader.nextRecord()) {
  if (record.type === "Schema") {
    const schema = JSON.parse(new TextDecoder().decode(record.data));
    demand(record.encoding === "jsonschema" && schema.type === "object", `${record.name}: no schema of JSON objects`);
    schemas.set(record.id, schema);
  } else if (record.type === "Channel") {
    demand(record.messageEncoding === "json", `${record.topic}: its messages are not declared as JSON`);
    topics[record.id] = { topic: record.topic, schema: schemas.get(record.schemaId), messages: 0 };
  } else if (record.type === "Message") {
    const topic = topics[record.channelId];
    const message = JSON.parse(new TextDecoder().decode(record.data));
    for (const [name, value] of Object.entries(message)) {
      const type = topic.schema.properties[name]?.type;
      demand(type in isOfType && isOfType[type](value), `${topic.topic}: ${name} is ${value}, its schema has ${type}`);
    }
    topic.messages += 1;
    topic.last = message;
    topic.last_time_ns = record.logTime.toString();
  }
}
demand(reader.done(), "the file does not end as MCAP does");
console.log(JSON.stringify(Object.values(topics)));
