// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What `terracut replay --foxglove` serves is taken by @foxglove/ws-protocol, the client of Lichtblick, under both of the
// protocol's names: 30 clouds in a row, none missing, decoded from the definition that was advertised. Texts that are no
// requests, pages of other origins and names that lead here are refused; a client that stops reading holds up no other.
// What `terracut view --foxglove` serves is played by a viewer: it stands, is sought, goes on to its end, and says so.
//
// node read_foxglove.mjs PROGRAM DRIVE

import assert from 'node:assert/strict'
import { spawn } from 'node:child_process'

const [program, drive] = process.argv.slice(2)

const modules = {}
try {
  const protocol = await import('@foxglove/ws-protocol')
  modules.foxglove = protocol.FoxgloveClient ? protocol : protocol.default
  modules.rosmsg = await import('@foxglove/rosmsg')
  modules.serialization = await import('@foxglove/rosmsg2-serialization')
  modules.WebSocket = (await import('ws')).WebSocket
} catch (missing) {
  console.log(`skipped: ${missing.message.split('\n')[0]}; ./tools/setup --all installs the readers`)
  process.exit(0)
}

const calibration = drive.replace(/pcap$/, 'calibration.xml')
async function serve(...words) {
  const process = spawn(program, [...words, '--foxglove', '127.0.0.1:0'])
  let said = ''
  const url = await new Promise((resolve, reject) => {
    process.stderr.on('data', data => {
      said += data
      const found = /ws:\/\/[0-9.]+:(\d+)/.exec(said)
      if (found) resolve(`ws://127.0.0.1:${found[1]}`)
    })
    process.once('exit', () => reject(new Error(said)))
  })
  return { url, end: () => { process.removeAllListeners('exit'); process.kill('SIGKILL') } }
}
const { url, end } = await serve('replay', drive, '--calibration', calibration, '--rate', '1', '--loop', '0')

/** So many clouds of a client, with their stamps. */
function clouds(protocol, wanted) {
  return new Promise((resolve, reject) => {
    const socket = new modules.WebSocket(url, [protocol])
    const client = new modules.foxglove.FoxgloveClient({ ws: socket })
    const decoders = new Map(), got = []
    let transform
    client.on('error', reject)
    client.on('advertise', channels => {
      for (const channel of channels) {
        if (!['/terracut/points', '/tf_static'].includes(channel.topic)) continue
        assert.deepEqual([channel.encoding, channel.schemaEncoding], ['cdr', 'ros2msg'])
        const decoder = new modules.serialization.MessageReader(modules.rosmsg.parse(channel.schema, { ros2: true }))
        decoders.set(client.subscribe(channel.id), { topic: channel.topic, decoder })
      }
    })
    client.on('message', ({ subscriptionId, data }) => {
      const { topic, decoder } = decoders.get(subscriptionId)
      const message = decoder.readMessage(data)
      if (topic === '/tf_static') transform = message.transforms[0]
      if (topic !== '/terracut/points' || got.length === wanted) return
      assert.equal(message.data.byteLength, message.width * message.point_step)
      got.push(message.header.stamp.sec + message.header.stamp.nanosec / 1e9)
      if (got.length < wanted) return
      assert.equal(socket.protocol, protocol)
      assert.equal(transform.child_frame_id, 'terracut_ground')
      client.close()
      resolve(got)
    })
  })
}

/** Why a connection does not come about, or what is answered to a text. */
function refusal(options, text) {
  return new Promise(resolve => {
    const socket = new modules.WebSocket(url, options.protocols ?? ['foxglove.sdk.v1'], options)
    socket.on('unexpected-response', (_, response) => resolve(response.statusCode))
    socket.on('error', error => resolve(error.message))
    socket.on('open', () => text !== undefined ? socket.send(text) : (socket.close(), resolve('open')))
    socket.on('message', (data, binary) => {
      const message = binary ? {} : JSON.parse(data)
      if (message.op === 'status') { socket.close(); resolve(message.message) }
    })
  })
}

try {
  // One that subscribes to everything and reads nothing, for as long as all of this takes.
  const stalled = new modules.WebSocket(url, ['foxglove.sdk.v1'])
  await new Promise(resolve => stalled.once('open', resolve))
  stalled.send(JSON.stringify({ op: 'subscribe', subscriptions: [{ id: 0, channelId: 1 }, { id: 1, channelId: 2 }] }))
  stalled.pause()

  for (const protocol of ['foxglove.websocket.v1', 'foxglove.sdk.v1']) {
    const stamps = await clouds(protocol, 30)
    const gaps = stamps.slice(1).map((stamp, i) => stamp - stamps[i]).filter(gap => gap > 0) // the drive begins anew
    assert.ok(gaps.length >= 25 && gaps.every(gap => Math.abs(gap - 0.1) < 0.02), `${protocol}: ${gaps}`)
    console.log(`${protocol}: 30 clouds, none between them missing`)
  }
  assert.equal(await refusal({}), 'open')
  assert.equal(await refusal({ origin: 'http://localhost:8080' }), 'open')
  assert.equal(await refusal({ origin: 'https://elsewhere.example' }), 403)
  assert.equal(await refusal({ headers: { Host: 'elsewhere.example' } }), 403)
  assert.equal(await refusal({ protocols: ['something.else'] }), 400)
  for (const text of ['', '{', '[]', '7', '{"op":7}', '{"op":"subscribe"}', '{"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]}',
    '{"op":"subscribe","subscriptions":[{"id":1,"channelId":4294967295}]}', '{"op":"unsubscribe","subscriptionIds":[9]}', '{"op":"advertise"}']) {
    assert.match(await refusal({}, text), /not understood|no such|not offered/, text)
  }
  stalled.terminate()
  console.log('foreign pages, other protocols and texts that are no requests are refused')
} finally {
  end()
}

/** A viewer that plays a capture by the protocol's binary messages, as foxglove-sdk 0.25 lays them out. */
class Player {
  constructor(url) {
    this.socket = new modules.WebSocket(url, ['foxglove.sdk.v1'])
    this.came = []
    this.wake = () => {}
    this.socket.on('message', (data, binary) => {
      this.came.push(binary ? this.decoded(data) : JSON.parse(data))
      this.wake()
    })
  }
  decoded(data) {
    if (data[0] === 1) return { op: 'cloud', time: data.readBigUInt64LE(5) }
    assert.equal(data[0], 5)
    assert.equal(data.length, 19 + data.readUInt32LE(15))
    return { op: 'state', status: data[1], time: data.readBigUInt64LE(2), speed: data.readFloatLE(10), seeks: data[14], id: data.toString('utf8', 19) }
  }
  /** The next message like this one; what came before it is dropped. */
  async next(isMeant) {
    for (;;) {
      while (this.came.length > 0) {
        const message = this.came.shift()
        if (isMeant(message)) return message
      }
      await new Promise(resolve => (this.wake = resolve))
    }
  }
  tell(command, speed, seek, id) {
    const request = Buffer.alloc(19 + id.length)
    request.writeUInt8(3, 0)
    request.writeUInt8(command, 1)
    request.writeFloatLE(speed, 2)
    request.writeUInt8(seek === undefined ? 0 : 1, 6)
    request.writeBigUInt64LE(seek ?? 0n, 7)
    request.writeUInt32LE(id.length, 15)
    request.write(id, 19)
    this.socket.send(request)
  }
}

const viewed = await serve('view', drive, '--calibration', calibration, '--at', '127.0.0.1:0')
try {
  const player = new Player(viewed.url)
  const info = await player.next(message => message.op === 'serverInfo')
  assert.deepEqual(info.capabilities, ['playbackControl'])
  const nanoseconds = time => BigInt(time.sec) * 1_000_000_000n + BigInt(time.nsec)
  const begin = nanoseconds(info.dataStartTime), finish = nanoseconds(info.dataEndTime)
  assert.ok(Math.abs(Number(finish - begin) / 1e9 - 1.3) < 0.2, `${begin} to ${finish}`)
  player.socket.send(JSON.stringify({ op: 'subscribe', subscriptions: [{ id: 0, channelId: 1 }] }))
  const sought = begin + 500_000_000n
  player.tell(1, 1, sought, 'seek')
  const stands = await player.next(message => message.id === 'seek')
  assert.deepEqual([stands.status, stands.seeks, stands.time], [1, 1, sought])
  // A cloud's time is that of its last packet.
  await player.next(message => message.op === 'cloud' && Math.abs(Number(message.time - sought) / 1e9 - 0.1) < 0.06)
  player.tell(0, 2, undefined, 'on')
  const plays = await player.next(message => message.id === 'on')
  assert.deepEqual([plays.status, plays.seeks, plays.speed], [0, 0, 2])
  // Over and over: after its end it begins again.
  await player.next(message => message.op === 'cloud' && message.time > finish - 300_000_000n)
  await player.next(message => message.op === 'cloud' && message.time < begin + 300_000_000n)
  player.socket.send(Buffer.from([3, 0]))
  await player.next(message => message.op === 'status' && /cut short/.test(message.message))
  player.socket.close()
  console.log('a capture stands, is sought and goes on as a viewer says')
} finally {
  viewed.end()
}
