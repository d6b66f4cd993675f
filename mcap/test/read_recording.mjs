// node read_recording.mjs NODE_MODULES RECORDING [TOPIC]... : reads an MCAP file by MCAP's own reader, decodes every message by its
// schema, and prints one JSON object: counts and time span by the summary, and by topic the schema, count, first and last message.
// Fails on whatever the reader finds wrong, and where summary and messages differ. Without topics: all.
import { open } from "node:fs/promises";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const [modules, file, ...topics] = process.argv.slice(2);
const require = createRequire(resolve(modules, "placeholder.js"));
const { McapIndexedReader, McapStreamReader } = require("@mcap/core");
const { parse } = require("@foxglove/rosmsg");
const { MessageReader } = require("@foxglove/rosmsg2-serialization");

function decoderOf(channel, schema) {
  if (channel.messageEncoding === "json" && schema.encoding === "jsonschema") {
    return (data) => JSON.parse(new TextDecoder().decode(data));
  }
  if (channel.messageEncoding === "cdr" && schema.encoding === "ros2msg") {
    const definition = parse(new TextDecoder().decode(schema.data), { ros2: true });
    const reader = new MessageReader(definition);
    return (data) => reader.readMessage(data);
  }
  throw new Error(`${channel.topic}: ${channel.messageEncoding} messages by a schema in ${schema.encoding}`);
}

/** The file as readers seek in it. */
async function readByIndex(handle) {
  const readable = {
    size: async () => BigInt((await handle.stat()).size),
    read: async (offset, length) => {
      const buffer = new Uint8Array(Number(length));
      const { bytesRead } = await handle.read(buffer, 0, Number(length), Number(offset));
      return buffer.subarray(0, bytesRead);
    },
  };
  const reader = await McapIndexedReader.Initialize({ readable });
  const found = new Map();
  let before = 0n;
  for await (const message of reader.readMessages(topics.length > 0 ? { topics } : {})) {
    if (message.logTime < before) throw new Error("messages are not in the order of time");
    before = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    if (!found.has(channel.id)) {
      const schema = reader.schemasById.get(channel.schemaId);
      found.set(channel.id, { topic: channel.topic, schema: schema.name, count: 0, decode: decoderOf(channel, schema) });
    }
    const entry = found.get(channel.id);
    const value = entry.decode(message.data);
    entry.count += 1;
    entry.first ??= value;
    entry.last = value;
    const counted = reader.statistics.channelMessageCounts.get(channel.id);
    if (BigInt(entry.count) > counted) throw new Error(`${channel.topic}: more than ${counted} messages`);
  }
  return { reader, found };
}

/** The same file from its beginning to its end, as a stream: chunks with their checksums. */
async function countInStream(handle) {
  const stream = new McapStreamReader({ validateCrcs: true });
  const buffer = new Uint8Array(1 << 20);
  let messages = 0;
  for (;;) {
    const { bytesRead } = await handle.read(buffer, 0, buffer.length);
    if (bytesRead === 0) break;
    stream.append(buffer.subarray(0, bytesRead));
    for (let record = stream.nextRecord(); record; record = stream.nextRecord()) messages += record.type === "Message" ? 1 : 0;
  }
  if (!stream.done()) throw new Error("the stream does not end as it should");
  return messages;
}

const handle = await open(file);
const { reader, found } = await readByIndex(handle);
await handle.close();
const second = await open(file);
const streamed = await countInStream(second);
await second.close();
const { messageCount, chunkCount, messageStartTime, messageEndTime } = reader.statistics;
if (BigInt(streamed) !== messageCount) throw new Error(`the summary counts ${messageCount} messages, the stream has ${streamed}`);
const text = (_key, value) => (typeof value === "bigint" ? Number(value) : ArrayBuffer.isView(value) ? Array.from(value) : value);
const channels = Object.fromEntries([...found.values()].map(({ topic, schema, count, first, last }) => [topic, { schema, count, first, last }]));
console.log(JSON.stringify({ profile: reader.header.profile, messageCount, chunkCount, messageStartTime, messageEndTime, channels }, text));
