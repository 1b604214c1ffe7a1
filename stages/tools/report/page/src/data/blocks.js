// SPDX-License-Identifier: GPL-3.0-or-later
// The page's data: gzip + base64 blocks written by the program `report` (page_block.h), unpacked when they are asked for.

const kArray = { u8: Uint8Array, u16: Uint16Array, u32: Uint32Array, i16: Int16Array, i32: Int32Array, f32: Float32Array };
const kAlignment = 8;

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) {
    bytes[i] = text.charCodeAt(i);
  }
  return bytes;
}

async function gunzip(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}

/** @returns {object} the block's JSON members, and its arrays by name */
export function parseBlock(buffer) {
  const length = new DataView(buffer).getUint32(0, true);
  const block = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const begin = Math.ceil((4 + length) / kAlignment) * kAlignment;
  for (const [name, [type, count, offset]] of Object.entries(block.arrays)) {
    block[name] = new kArray[type](buffer, begin + offset, count);
  }
  delete block.arrays;
  return block;
}

const loaded = new Map();

/** The block of that name, or null when the run had nothing to put into it. Unpacked once. */
export function loadBlock(name) {
  if (!loaded.has(name)) {
    const element = document.getElementById(`block-${name}`);
    loaded.set(
      name,
      element ? gunzip(bytesOf(element.textContent)).then(parseBlock) : Promise.resolve(null),
    );
  }
  return loaded.get(name);
}
