// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// Clouds in a bag that @mcap/core has written are labelled as those in the bag of `--mcap` from which they came, byte for byte.
//
// node rewrite_mcap.mjs PROGRAM DRIVE WORK_FOLDER

import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import fs from 'node:fs'
import path from 'node:path'

const [program, drive, folder] = process.argv.slice(2)

const modules = {}
try {
  modules.mcap = await import('@mcap/core')
  modules.fzstd = await import('fzstd')
} catch (missing) {
  console.log(`skipped: ${missing.message.split('\n')[0]}; ./tools/setup --all installs the readers`)
  process.exit(0)
}

fs.rmSync(folder, { recursive: true, force: true })
fs.mkdirSync(folder, { recursive: true })
const own = path.join(folder, 'own.mcap')
const theirs = path.join(folder, 'theirs.mcap')
execFileSync(program, ['replay', drive, '--mcap', own], { stdio: 'pipe' })

const bytes = fs.readFileSync(own)
const readable = {
  size: async () => BigInt(bytes.length),
  read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size))),
}
const decompressHandlers = { zstd: packed => modules.fzstd.decompress(packed) }
const reader = await modules.mcap.McapIndexedReader.Initialize({ readable, decompressHandlers })

const parts = []
let position = 0n
const writable = {
  position: () => position,
  write: async buffer => {
    parts.push(Buffer.from(buffer))
    position += BigInt(buffer.byteLength)
  },
}
const writer = new modules.mcap.McapWriter({ writable, chunkSize: 3_000_000 })
await writer.start({ profile: 'ros2', library: 'test' })
const channels = new Map()
for (const channel of reader.channelsById.values()) {
  const schema = reader.schemasById.get(channel.schemaId)
  const schemaId = await writer.registerSchema({ name: schema.name, encoding: schema.encoding, data: schema.data })
  channels.set(channel.id, await writer.registerChannel({ ...channel, schemaId }))
}
for await (const message of reader.readMessages()) {
  await writer.addMessage({ ...message, channelId: channels.get(message.channelId) })
}
await writer.end()
fs.writeFileSync(theirs, Buffer.concat(parts))

function labelsOf(bag) {
  const labels = path.join(folder, path.basename(bag, '.mcap'))
  execFileSync(program, ['segment', bag, '--labels', labels], { stdio: 'pipe' })
  return fs.readdirSync(labels).filter(name => name.endsWith('.label')).sort().map(name => [name, fs.readFileSync(path.join(labels, name))])
}
const expected = labelsOf(own)
assert.ok(expected.length >= 10)
assert.deepEqual(labelsOf(theirs), expected)
console.log(`${expected.length} clouds labelled the same`)
