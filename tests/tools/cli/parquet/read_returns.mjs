// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What `terracut replay --parquet` writes is read by three programs that share no code with it or with each other: DuckDB
// (C++), hyparquet (JavaScript) and parquet-wasm (Rust). Each must read what the .label and .pcd files of the same run say,
// and refuse a file that was cut short, or values of which a bit has flipped.
//
// node read_returns.mjs PROGRAM DRIVE WORK_FOLDER

import assert from 'node:assert/strict'
import { execFileSync } from 'node:child_process'
import fs from 'node:fs'
import path from 'node:path'

const [program, drive, folder] = process.argv.slice(2)

const modules = {}
try {
  modules.duckdb = await import('@duckdb/node-api')
  modules.hyparquet = await import('hyparquet')
  modules.parquetHeader = (await import('hyparquet/src/column.js')).parquetHeader
  modules.compressors = (await import('hyparquet-compressors')).compressors
  modules.zstd = await import('@bokuweb/zstd-wasm')
  await modules.zstd.init()
  modules.wasm = await import('parquet-wasm/node')
  modules.arrow = await import('apache-arrow')
} catch (missing) {
  console.log(`skipped: ${missing.message.split('\n')[0]}; ./tools/setup --all installs the readers`)
  process.exit(0)
}

const COLUMNS = ['frame', 'return', 'stamp', 'ring', 'column', 'x', 'y', 'z', 'intensity', 'label', 'height']
const GROUND = [40, 49]

// Each reader: file -> { types, columns: { name: array of numbers } }; throws on a file it refuses.

const database = await (await modules.duckdb.DuckDBInstance.create(':memory:')).connect()

async function query(text) {
  return (await database.runAndReadAll(text)).getRowObjectsJS()
}

async function readByDuckdb(file) {
  const types = Object.fromEntries((await query(`describe select * from '${file}'`)).map(row => [row.column_name, row.column_type]))
  const wanted = COLUMNS.map(name => (name === 'stamp' ? 'epoch_ns(stamp)' : `"${name}"`)).join(', ')
  const read = (await database.runAndReadAll(`select ${wanted} from '${file}'`)).getColumnsJS()
  return { types, columns: Object.fromEntries(COLUMNS.map((name, i) => [name, read[i].map(Number)])) }
}

async function readByHyparquet(file, compressors = modules.compressors) {
  const bytes = fs.readFileSync(file)
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length)
  const metadata = await modules.hyparquet.parquetMetadataAsync(buffer)
  const types = Object.fromEntries(metadata.schema.slice(1).map(element => [element.name, element.converted_type ?? element.logical_type?.type ?? element.type]))
  const columns = Object.fromEntries(COLUMNS.map(name => [name, []]))
  await modules.hyparquet.parquetRead({
    file: buffer,
    compressors,
    rowFormat: 'object',
    parsers: { ...modules.hyparquet.parquetReadParsers, timestampFromNanoseconds: Number },
    onComplete: rows => rows.forEach(row => COLUMNS.forEach(name => columns[name].push(Number(row[name])))),
  })
  return { types, columns }
}

/** By the decompressor of zstd's authors: hyparquet's own does not look at the checksum of what it decompresses. */
async function readByHyparquetWithZstd(file) {
  const ZSTD = (bytes, length) => modules.zstd.decompress(bytes, { defaultHeapSize: length })
  return readByHyparquet(file, { ...modules.compressors, ZSTD })
}

async function readByWasm(file) {
  const table = modules.arrow.tableFromIPC(modules.wasm.readParquet(new Uint8Array(fs.readFileSync(file))).intoIPCStream())
  const types = Object.fromEntries(table.schema.fields.map(field => [field.name, field.type.toString()]))
  const columns = {}
  for (const name of COLUMNS) {
    const batches = table.getChild(name).data.map(data => data.values)
    columns[name] = batches.flatMap(values => Array.from(values, Number))
  }
  return { types, columns }
}

// Of each: how it reads, the types it should find, and how it reads what may be damaged where that is another way.
const READERS = {
  duckdb: [readByDuckdb, {
    frame: 'UINTEGER', return: 'UINTEGER', stamp: 'TIMESTAMP WITH TIME ZONE', ring: 'USMALLINT', column: 'USMALLINT', x: 'FLOAT',
    y: 'FLOAT', z: 'FLOAT', intensity: 'UTINYINT', label: 'UTINYINT', height: 'FLOAT',
  }],
  hyparquet: [readByHyparquet, {
    frame: 'UINT_32', return: 'UINT_32', stamp: 'TIMESTAMP', ring: 'UINT_16', column: 'UINT_16', x: 'FLOAT', y: 'FLOAT', z: 'FLOAT',
    intensity: 'UINT_8', label: 'UINT_8', height: 'FLOAT',
  }, readByHyparquetWithZstd],
  'parquet-wasm': [readByWasm, {
    frame: 'Uint32', return: 'Uint32', stamp: 'Timestamp<NANOSECOND, UTC>', ring: 'Uint16', column: 'Uint16', x: 'Float32', y: 'Float32',
    z: 'Float32', intensity: 'Uint8', label: 'Uint8', height: 'Float32',
  }],
}

// What the run says in its other files, as columns.

function numbered(name, ending) {
  return fs.readdirSync(path.join(folder, name)).filter(file => file.endsWith(ending)).sort()
}

function pointsOf(pcd) {
  const bytes = fs.readFileSync(pcd)
  const begin = bytes.indexOf('DATA binary\n') + 12
  const view = new DataView(bytes.buffer, bytes.byteOffset + begin, bytes.length - begin)
  return { view, count: view.byteLength / 20 }
}

function expectedColumns(report) {
  const expected = Object.fromEntries(['frame', 'return', 'stamp', 'ring', 'x', 'y', 'z', 'intensity', 'label'].map(name => [name, []]))
  numbered('labels', '.label').forEach((file, frame) => {
    const bytes = fs.readFileSync(path.join(folder, 'labels', file))
    const { view, count } = pointsOf(path.join(folder, 'pcd', file.replace('.label', '.pcd')))
    assert.equal(bytes.length / 4, count)
    for (let i = 0; i < count; ++i) {
      expected.frame.push(frame)
      expected.return.push(i)
      expected.stamp.push(report.frames[frame].first_packet_ns)
      expected.label.push(bytes.readUInt32LE(4 * i))
      expected.x.push(view.getFloat32(20 * i, true))
      expected.y.push(view.getFloat32(20 * i + 4, true))
      expected.z.push(view.getFloat32(20 * i + 8, true))
      expected.intensity.push(view.getFloat32(20 * i + 12, true))
      expected.ring.push(view.getUint16(20 * i + 16, true))
    }
  })
  return expected
}

/** A sum that tells two columns apart: FNV-1a over their numbers. */
function sumOf(values) {
  const bytes = new Uint32Array(new Float64Array(values).buffer)
  let hash = 0x811c9dc5
  for (const word of bytes) hash = Math.imul(hash ^ word, 0x01000193) >>> 0
  return `${values.length}:${hash}`
}

function sumsOf(read) {
  return Object.fromEntries(COLUMNS.map(name => [name, sumOf(read.columns[name])]))
}

function replay(duration, ...outputs) {
  const calibration = drive.replace(/pcap$/, 'calibration.xml')
  execFileSync(program, ['replay', drive, '--calibration', calibration, '--duration', duration, ...outputs], { cwd: folder, stdio: 'ignore' })
}

async function checkWhole() {
  replay('0.5', '--labels', 'labels', '--pcd', 'pcd', '--json', 'report.json', '--parquet', 'returns.parquet', '--metadata', 'vehicle=7=b')
  const file = path.join(folder, 'returns.parquet')
  const expected = expectedColumns(JSON.parse(fs.readFileSync(path.join(folder, 'report.json'))))
  const rows = expected.label.length
  const ground = expected.label.filter(label => GROUND.includes(label)).length
  assert.ok(ground > 0.1 * rows && ground < 0.9 * rows)
  const heights = new Set()
  for (const [name, [read, types]] of Object.entries(READERS)) {
    const got = await read(file)
    assert.deepEqual(got.types, types, name)
    for (const [column, values] of Object.entries(expected)) assert.equal(sumOf(got.columns[column]), sumOf(values), `${name}: ${column}`)
    assert.equal(got.columns.label.filter(label => GROUND.includes(label)).length, ground, name)
    assert.ok(got.columns.column.every(column => column >= 0 && column < 2200), name)
    assert.ok(got.columns.height.every((height, i) => GROUND.includes(got.columns.label[i]) ? height < 1 : height > -5), name)
    heights.add(sumOf(got.columns.height) + sumOf(got.columns.column))
  }
  assert.equal(heights.size, 1, 'the readers agree')

  const groups = await query(`select row_group_id as id, row_group_num_rows as rows, path_in_schema as name, stats_min_value as least,
    stats_max_value as greatest, compression from parquet_metadata('${file}')`)
  const frames = numbered('labels', '.label').length
  assert.equal(groups.length, frames * COLUMNS.length)
  for (const group of groups) {
    assert.equal(group.compression, 'ZSTD')
    if (group.name === 'frame') assert.deepEqual([group.least, group.greatest], [String(group.id), String(group.id)])
    if (group.name === 'return') assert.deepEqual([group.least, group.greatest], ['0', String(Number(group.rows) - 1)])
  }
  assert.deepEqual(await query(`select key::varchar as key, value::varchar as value from parquet_kv_metadata('${file}')`), [{ key: 'vehicle', value: '7=b' }])
  const [{ count }] = await query(`select count(*) as count from '${file}' where frame = 2 and label = 40`)
  assert.equal(Number(count), expected.label.filter((label, i) => label === 40 && expected.frame[i] === 2).length)
  const bytes = fs.statSync(file).size
  console.log(`${rows} rows of ${frames} frames, ${ground} ground: the same by ${Object.keys(READERS).join(', ')}; ${(bytes / rows).toFixed(2)} bytes a return`)
}

/** As Parquet wants it: of the page as it is compressed. */
function crc32(bytes) {
  let crc = ~0
  for (const byte of bytes) {
    crc ^= byte
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1
  }
  return ~crc
}

function checkPageSums(file) {
  const { buffer } = Uint8Array.from(fs.readFileSync(file))
  const groups = modules.hyparquet.parquetMetadata(buffer).row_groups
  for (const { meta_data: { data_page_offset: begin } } of groups.flatMap(group => group.columns)) {
    const reader = { view: new DataView(buffer, Number(begin)), offset: 0 }
    const header = modules.parquetHeader(reader)
    assert.equal(header.crc, crc32(new Uint8Array(buffer, Number(begin) + reader.offset, header.compressed_page_size)))
  }
}

/** refused, the same, or misread. */
async function judge(read, file, good) {
  try {
    return JSON.stringify(sumsOf(await read(file))) === JSON.stringify(good) ? 'same' : 'misread'
  } catch {
    return 'refused'
  }
}

async function checkDamaged() {
  replay('0.1', '--parquet', 'one.parquet')
  checkPageSums(path.join(folder, 'one.parquet'))
  const whole = fs.readFileSync(path.join(folder, 'one.parquet'))
  const footer = whole.length - 8 - whole.readUInt32LE(whole.length - 8)
  const good = Object.fromEntries(await Promise.all(Object.entries(READERS).map(async ([name, [read]]) => [name, sumsOf(await read(path.join(folder, 'one.parquet')))])))
  let seed = 1
  const random = below => (seed = (seed * 48271) % 0x7fffffff) % below
  const trial = async (kind, number, damage) => {
    const found = {}
    for (let i = 0; i < number; ++i) {
      const file = path.join(folder, `${kind}${i}.parquet`) // a name of its own, for readers keep what they know of one
      fs.writeFileSync(file, damage(i))
      for (const [name, [read, , readDamaged = read]] of Object.entries(READERS)) {
        const verdict = await judge(readDamaged, file, good[name])
        found[name] = { ...found[name], [verdict]: (found[name]?.[verdict] ?? 0) + 1 }
      }
      fs.rmSync(file)
    }
    const file = path.join(folder, `${kind}.parquet`)
    fs.writeFileSync(file, whole)
    for (const [name, [read, , readDamaged = read]] of Object.entries(READERS)) {
      assert.equal(await judge(readDamaged, file, good[name]), 'same', `${name} still reads what is whole`)
    }
    console.log(kind, JSON.stringify(found))
    return found
  }
  const flipped = at => {
    const bytes = Buffer.from(whole)
    bytes[at] ^= 1 << random(8)
    return bytes
  }
  const cut = await trial('cut', 10, i => whole.subarray(0, i < 5 ? whole.length - 1 - i : random(whole.length)))
  for (const [name, verdicts] of Object.entries(cut)) assert.deepEqual(Object.keys(verdicts), ['refused'], `${name}, of files cut short`)
  const pages = await trial('a bit of the pages', 20, () => flipped(4 + random(footer - 4)))
  for (const [name, verdicts] of Object.entries(pages)) assert.ok(!verdicts.misread, `${name} checks what zstd sums up`)
  await trial('a bit of the footer', 20, () => flipped(footer + random(whole.length - footer)))
}

fs.rmSync(folder, { recursive: true, force: true })
fs.mkdirSync(folder, { recursive: true })
await checkWhole()
await checkDamaged()
