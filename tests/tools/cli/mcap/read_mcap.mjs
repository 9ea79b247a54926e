// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What `terracut replay --mcap` writes is read by @mcap/core, with which Lichtblick and Foxglove's web app open recordings,
// and decoded by @foxglove/rosmsg2-serialization from nothing but the definitions in the file. Every message must say what
// the .label files and the report of the same run say; a recording whose writer was killed is read up to its last chunk.
//
// node read_mcap.mjs PROGRAM DRIVE WORK_FOLDER

import assert from 'node:assert/strict'
import { execFileSync, spawn } from 'node:child_process'
import fs from 'node:fs'
import path from 'node:path'

const [program, drive, folder] = process.argv.slice(2)

const modules = {}
try {
  modules.mcap = await import('@mcap/core')
  modules.rosmsg = await import('@foxglove/rosmsg')
  modules.serialization = await import('@foxglove/rosmsg2-serialization')
  modules.fzstd = await import('fzstd')
} catch (missing) {
  console.log(`skipped: ${missing.message.split('\n')[0]}; ./tools/setup --all installs the readers`)
  process.exit(0)
}

const decompressHandlers = { zstd: bytes => modules.fzstd.decompress(bytes) }
const GROUND = [40, 49]

const decoders = new Map()
function decode(schema, data) {
  if (!decoders.has(schema.name)) {
    const definition = new TextDecoder().decode(schema.data)
    decoders.set(schema.name, new modules.serialization.MessageReader(modules.rosmsg.parse(definition, { ros2: true })))
  }
  return decoders.get(schema.name).readMessage(data)
}

/** { topic: [{ time, message }] }, by the file's index. */
async function readIndexed(file) {
  const descriptor = fs.openSync(file)
  const readable = {
    size: async () => BigInt(fs.fstatSync(descriptor).size),
    read: async (offset, size) => {
      const bytes = new Uint8Array(Number(size))
      assert.equal(fs.readSync(descriptor, bytes, 0, bytes.length, Number(offset)), bytes.length)
      return bytes
    },
  }
  const reader = await modules.mcap.McapIndexedReader.Initialize({ readable, decompressHandlers })
  const topics = Object.fromEntries([...reader.channelsById.values()].map(channel => [channel.topic, []]))
  for await (const { channelId, logTime, data } of reader.readMessages()) {
    const channel = reader.channelsById.get(channelId)
    topics[channel.topic].push({ time: logTime, message: decode(reader.schemasById.get(channel.schemaId), data) })
  }
  const metadata = {}
  for await (const record of reader.readMetadata()) Object.assign(metadata, Object.fromEntries(record.metadata))
  fs.closeSync(descriptor)
  return { reader, topics, metadata }
}

/** As above, from the beginning, with every sum checked; `whole`: whether it got to the end of the file. */
function readStream(bytes) {
  const reader = new modules.mcap.McapStreamReader({ decompressHandlers, validateCrcs: true })
  reader.append(bytes)
  const channels = new Map(), schemas = new Map(), topics = {}
  for (let record; (record = reader.nextRecord());) {
    if (record.type === 'Schema') schemas.set(record.id, record)
    if (record.type === 'Channel') channels.set(record.id, record)
    if (record.type !== 'Message') continue
    const channel = channels.get(record.channelId)
    topics[channel.topic] ??= []
    topics[channel.topic].push({ time: record.logTime, message: decode(schemas.get(channel.schemaId), record.data) })
  }
  return { topics, whole: reader.done() }
}

function replay(...outputs) {
  const calibration = drive.replace(/pcap$/, 'calibration.xml')
  execFileSync(program, ['replay', drive, '--calibration', calibration, ...outputs], { cwd: folder, stdio: 'ignore' })
}

function points({ data, point_step: step, width }) {
  const view = new DataView(data.buffer, data.byteOffset, data.byteLength)
  return Array.from({ length: width }, (_, i) => ({
    x: view.getFloat32(i * step, true), z: view.getFloat32(i * step + 8, true), intensity: view.getFloat32(i * step + 12, true),
    ring: view.getUint16(i * step + 16, true), label: view.getUint8(i * step + 18), time: view.getFloat32(i * step + 20, true),
  }))
}

function checkCloud({ message }, first_ns, labels, rings) {
  assert.equal(message.header.frame_id, 'terracut_ground')
  assert.equal(message.header.stamp.sec * 1e9 + message.header.stamp.nanosec, first_ns)
  assert.deepEqual(message.fields.map(field => field.name), ['x', 'y', 'z', 'intensity', 'ring', 'label', 'time'])
  assert.equal(message.data.byteLength, message.width * message.point_step)
  assert.equal(message.row_step, message.data.byteLength)
  const got = points(message)
  assert.deepEqual(got.map(point => point.label), labels)
  for (const { x, z, intensity, ring, time } of got) {
    assert.ok(Math.abs(x) < 150 && z > -5 && z < 30 && intensity >= 0 && intensity <= 255 && ring < rings)
    assert.ok(time >= 0 && time < 0.12, `${time} s in a frame`)
  }
  return got
}

async function checkWhole() {
  replay('--duration', '1', '--labels', 'labels', '--json', 'report.json', '--mcap', 'drive.mcap', '--mcap-clouds', 'all')
  const report = JSON.parse(fs.readFileSync(path.join(folder, 'report.json')))
  const labelFiles = fs.readdirSync(path.join(folder, 'labels')).filter(name => name.endsWith('.label')).sort()
  const file = path.join(folder, 'drive.mcap')
  const { reader, topics } = await readIndexed(file)
  assert.equal(reader.header.profile, 'ros2')
  assert.deepEqual([...reader.channelsById.values()].map(channel => channel.messageEncoding), Array(reader.channelsById.size).fill('cdr'))
  assert.ok(labelFiles.length >= 5)
  const counts = Object.fromEntries(Object.entries(topics).map(([topic, messages]) => [topic, messages.length]))
  for (const topic of ['points', 'ground', 'obstacles']) assert.equal(counts[`/terracut/${topic}`], labelFiles.length, topic)
  assert.equal(counts['/tf_static'], 1)
  assert.equal(Number(reader.statistics.messageCount), Object.values(counts).reduce((sum, count) => sum + count))

  let last = []
  labelFiles.forEach((name, i) => {
    const bytes = fs.readFileSync(path.join(folder, 'labels', name))
    const labels = Array.from({ length: bytes.length / 4 }, (_, k) => bytes.readUInt32LE(4 * k))
    const first_ns = report.frames[i].first_packet_ns
    last = checkCloud(topics['/terracut/points'][i], first_ns, labels, 64)
    checkCloud(topics['/terracut/ground'][i], first_ns, labels.filter(label => GROUND.includes(label)), 64)
    checkCloud(topics['/terracut/obstacles'][i], first_ns, labels.filter(label => label === 99), 64)
  })
  // In order of arrival, so times rise but for what the lasers of one firing are apart: 10 degrees.
  let newest = 0
  for (const { time } of last) {
    assert.ok(time > newest - 0.006, `${time} s after ${newest}`)
    newest = Math.max(newest, time)
  }
  assert.ok(newest > 0.09, `a frame takes ${newest} s`)
  const [{ message: { transforms: [transform] } }] = topics['/tf_static']
  assert.deepEqual([transform.header.frame_id, transform.child_frame_id], ['terracut_lidar', 'terracut_ground'])
  assert.ok(transform.transform.translation.z < -1 && Math.abs(transform.transform.rotation.w) > 0.99)

  const bytes = fs.readFileSync(file)
  const { topics: streamed, whole } = readStream(bytes)
  assert.ok(whole)
  assert.deepEqual(streamed, Object.fromEntries(Object.entries(topics).filter(([, messages]) => messages.length > 0)))
  const damaged = Buffer.from(bytes)
  damaged[bytes.length >> 1] ^= 1
  assert.throws(() => readStream(damaged))
  console.log(`${labelFiles.length} frames, ${reader.statistics.messageCount} messages in ${bytes.length} bytes: the same by index and in order`)
}

async function checkObjects() {
  replay('--duration', '0.5', '--labels', 'numbered', '--objects', '--mcap', 'objects.mcap')
  const { topics } = await readIndexed(path.join(folder, 'objects.mcap'))
  const names = fs.readdirSync(path.join(folder, 'numbered')).filter(name => name.endsWith('.label')).sort()
  assert.equal(topics['/terracut/objects'].length, names.length)
  let objects = 0
  names.forEach((name, i) => {
    const bytes = fs.readFileSync(path.join(folder, 'numbered', name))
    const numbers = Array.from({ length: bytes.length / 4 }, (_, k) => bytes.readUInt16LE(4 * k + 2))
    const { header, detections } = topics['/terracut/objects'][i].message
    assert.deepEqual(header, topics['/terracut/points'][i].message.header)
    assert.equal(detections.length, numbers.reduce((most, number) => Math.max(most, number)))
    assert.deepEqual(detections.map(({ id }) => id), detections.map((_, k) => String(k + 1)))
    for (const { bbox: { center: { position, orientation }, size } } of detections) {
      assert.ok(Math.hypot(position.x, position.y) < 150 && size.x >= size.y && size.z > 0 && size.z < 20)
      assert.ok(Math.abs(Math.hypot(orientation.z, orientation.w) - 1) < 1e-5 && orientation.x === 0 && orientation.y === 0)
    }
    const { markers: [boxes, footprints] } = topics['/terracut/objects/markers'][i].message
    assert.deepEqual([boxes.ns, boxes.type, footprints.ns], ['boxes', 5, 'footprints'])
    assert.equal(boxes.points.length, 24 * detections.length)
    assert.ok(footprints.points.length >= 2 * detections.length && footprints.points.length % 2 === 0)
    assert.ok(Math.abs(boxes.scale.x - 0.05) < 1e-9 && boxes.color.a === 1 && boxes.pose.orientation.w === 1)
    objects += detections.length
  })
  assert.ok(objects > 10 * names.length)
  console.log(`${objects} objects in ${names.length} frames`)
}

async function checkFreeWay() {
  replay('--duration', '0.5', '--free-way', '--mcap', 'way.mcap')
  const { topics } = await readIndexed(path.join(folder, 'way.mcap'))
  const scans = topics['/terracut/free_way']
  assert.equal(scans.length, topics['/terracut/points'].length)
  assert.ok(!topics['/terracut/objects'])
  scans.forEach(({ message: scan }, i) => {
    assert.deepEqual(scan.header, topics['/terracut/points'][i].message.header)
    assert.equal(scan.ranges.length, 720)
    assert.equal(scan.intensities.length, 720)
    assert.ok(Math.abs(scan.angle_min + Math.PI) < 0.01 && scan.angle_increment > 0 && scan.time_increment === 0)
    assert.ok(Math.abs(scan.angle_max - scan.angle_min - 719 * scan.angle_increment) < 1e-4)
    assert.ok(scan.ranges.every(range => Number.isNaN(range) || (range > 0 && (range < 200 || range === Infinity))))
    const { points } = topics['/terracut/free_way/polygon'][i].message.polygon
    assert.equal(points.length, 2 * scan.ranges.length)
    points.forEach(({ x, y, z }, k) => {
      const ray = ((k >> 1) + 360) % 720 // the polygon begins straight ahead, the scan behind
      const [range, seen] = [scan.ranges[ray], scan.intensities[ray]]
      const free = Number.isNaN(range) ? seen : Math.min(range, seen)
      assert.ok(z === 0 && Math.abs(Math.hypot(x, y) - free) < 1e-3)
    })
    const { info, data } = topics['/terracut/free_way/grid'][i].message
    assert.equal(data.length, info.width * info.height)
    assert.ok(Math.abs(info.origin.position.x + 20) < 1e-5 && Math.abs(info.origin.position.y + 20) < 1e-5)
    assert.ok([-1, 0, 100].every(value => data.includes(value)) && data.every(value => [-1, 0, 100].includes(value)))
  })
  console.log(`the free way of ${scans.length} frames`)
}

async function checkBag() {
  replay('--duration', '1', '--mcap', 'bag', '--mcap-split-s', '0.4')
  const metadata = fs.readFileSync(path.join(folder, 'bag/metadata.yaml'), 'utf8')
  const files = [...metadata.matchAll(/path: "(.*)"[\s\S]*?message_count: (\d+)/g)]
  assert.ok(files.length >= 2)
  let messages = 0
  for (const [, name, count] of files) {
    const { reader, topics } = await readIndexed(path.join(folder, 'bag', name))
    assert.equal(Number(reader.statistics.messageCount), Number(count))
    assert.equal(topics['/tf_static'].length, 1, 'each file stands for itself')
    assert.ok(topics['/terracut/points'] && !topics['/terracut/ground'], 'each point once')
    messages += Number(count)
  }
  assert.equal(Number(/^  message_count: (\d+)/m.exec(metadata)[1]), messages)
  console.log(`a bag of ${files.length} files`)
}

async function checkKilled() {
  const calibration = drive.replace(/pcap$/, 'calibration.xml')
  const running = spawn(program, ['replay', drive, '--calibration', calibration, '--loop', '0', '--mcap', 'killed.mcap'], { cwd: folder, stdio: 'ignore' })
  const gone = new Promise(resolve => running.once('exit', resolve))
  const part = () => fs.readdirSync(folder).find(name => name.startsWith('killed.mcap.part-'))
  const isLong = () => part() !== undefined && fs.statSync(path.join(folder, part())).size > 20e6
  while (!isLong() && running.exitCode === null) await new Promise(resolve => setTimeout(resolve, 20))
  running.kill('SIGKILL')
  await gone
  assert.ok(!fs.existsSync(path.join(folder, 'killed.mcap')), 'what is not whole has not its name')
  const bytes = fs.readFileSync(path.join(folder, part()))
  const { topics, whole } = readStream(bytes)
  assert.ok(!whole)
  const frames = topics['/terracut/points'].length
  // The last chunk may be in pieces, which is a frame's clouds at most.
  const chunks = [...chunksOf(bytes)]
  assert.ok(frames >= 5 && chunks.at(-1).end <= bytes.length)
  const messages = Object.values(topics).reduce((sum, each) => sum + each.length, 0)
  assert.equal(messages, chunks.reduce((sum, chunk) => sum + chunk.messages, 0), 'all of every whole chunk')
  console.log(`killed after ${bytes.length} bytes: ${frames} frames in ${chunks.length} chunks can be read`)
}

async function checkRelabel() {
  for (const ending of ['pcap', 'calibration.xml']) fs.copyFileSync(drive.replace(/pcap$/, ending), path.join(folder, `fleet/drive.${ending}`))
  execFileSync(program, ['manifest', 'fleet', '-o', 'fleet.json'], { cwd: folder, stdio: 'ignore' })
  execFileSync(program, ['relabel', 'fleet.json', '-o', 'out', '--format', 'mcap'], { cwd: folder, stdio: 'ignore' })
  const [done] = fs.readdirSync(path.join(folder, 'out')).filter(name => name.startsWith('drive-'))
  const { topics, metadata } = await readIndexed(path.join(folder, 'out', done, 'returns.mcap'))
  const { frames } = JSON.parse(fs.readFileSync(path.join(folder, 'out', done, 'terracut.json')))
  assert.equal(topics['/terracut/points'].length, frames)
  assert.match(metadata['terracut.recipe'], /"calibration"/)
  execFileSync('sha256sum', ['--quiet', '-c', 'SHA256SUMS'], { cwd: path.join(folder, 'out', done) })
  console.log(`relabelled: ${frames} frames`)
}

/** Chunks that are whole, with the messages in them. */
function* chunksOf(bytes) {
  for (let at = 8; at + 9 <= bytes.length;) {
    const end = at + 9 + Number(bytes.readBigUInt64LE(at + 1))
    if (end > bytes.length) return
    if (bytes[at] === 6) {
      const text = bytes.readUInt32LE(at + 9 + 28)
      const records = modules.fzstd.decompress(bytes.subarray(at + 9 + 32 + text + 8, end))
      const view = new DataView(records.buffer, records.byteOffset, records.byteLength)
      let messages = 0
      for (let inner = 0; inner < records.length; inner += 9 + Number(view.getBigUint64(inner + 1, true))) messages += records[inner] === 5 ? 1 : 0
      yield { end, messages }
    }
    at = end
  }
}

fs.rmSync(folder, { recursive: true, force: true })
fs.mkdirSync(folder, { recursive: true })
await checkWhole()
await checkObjects()
await checkFreeWay()
await checkBag()
await checkKilled()
fs.mkdirSync(path.join(folder, 'fleet'))
await checkRelabel()
fs.rmSync(folder, { recursive: true })
