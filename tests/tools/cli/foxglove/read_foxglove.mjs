// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The terracut authors
//
// What `terracut replay --foxglove` serves is taken by @foxglove/ws-protocol, the client of Lichtblick, under both of the
// protocol's names: 30 clouds in a row, none missing, decoded from the definition that was advertised. Texts that are no
// requests, pages of other origins and names that lead here are refused; a client that stops reading holds up no other.
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
const server = spawn(program, ['replay', drive, '--calibration', calibration, '--rate', '1', '--loop', '0', '--foxglove', '127.0.0.1:0'])
let said = ''
const url = await new Promise((resolve, reject) => {
  server.stderr.on('data', data => {
    said += data
    const found = /ws:\/\/[0-9.]+:(\d+)/.exec(said)
    if (found) resolve(`ws://127.0.0.1:${found[1]}`)
  })
  server.once('exit', () => reject(new Error(said)))
})

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
  server.removeAllListeners('exit')
  server.kill('SIGKILL')
}
