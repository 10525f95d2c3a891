import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Stack } from './stack.mjs';

const symbols = new Map([['_stack_end', { address: 0x20000101, size: 0 }]]);

test('the deepest word that was written counts', () => {
  const view = new DataView(new ArrayBuffer(0x1000));
  const stack = new Stack(symbols, view, 0x20001000);
  assert.deepEqual(stack.toJSON(), { used: 0, size: 0xefc });
  view.setUint32(0xffc, 1, true);
  view.setUint32(0x200, 1, true);
  view.setUint32(0x800, 1, true);
  assert.deepEqual(stack.toJSON(), { used: 0xe00, size: 0xefc });
  assert.equal(stack.overflown, false);
  view.setUint32(0x104, 1, true);
  assert.equal(stack.overflown, true);
});

test('painted anew, it is as deep as the stack pointer and what is written from then on', () => {
  const stack = new Stack(symbols, new DataView(new ArrayBuffer(0x1000)), 0x20001000);
  stack.view.setUint32(0x200, 1, true);
  stack.view.setUint32(0xff0, 1, true);
  stack.paint(0x20000f00);
  assert.deepEqual(stack.toJSON(), { used: 0x10, size: 0xefc });
  stack.view.setUint32(0x800, 1, true);
  assert.equal(stack.toJSON().used, 0x800);
});

test('an image without symbols has no known stack', () => {
  const stack = new Stack(new Map(), new DataView(new ArrayBuffer(0x1000)), 0x20001000);
  assert.deepEqual([stack.toJSON(), stack.overflown], [{ used: 0, size: 0 }, false]);
});
