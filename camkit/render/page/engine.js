// What computes a page: the program that was recorded.

/**
 * @typedef {ArrayLike<number>[] & {structure?: any, sentence?: string}} Outputs
 * @typedef {(values: Float64Array) => Outputs} Run
 * @typedef {{run(values: Float64Array, must?: boolean): Outputs | Promise<Outputs>, twin?: () => Run, end?(): void}} Engine
 * what `must` be answered is not left out for a newer question; `twin` gives another one of the same program, with numbers of
 * its own: what one computes is not done again because of the other; `end` when nobody asks any more
 */

/** The engine of a program, from what gzip packed. @param {Uint8Array} bytes @returns {Promise<Engine>} */
export async function engineOf(bytes) {
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  const numbers = JSON.parse(text), twin = () => machine(...numbers); // what runs any program stands before the modules
  return { run: twin(), twin };
}
