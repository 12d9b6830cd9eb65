// What computes a page: the program that was recorded.

/**
 * @typedef {ArrayLike<number>[] & {structure?: any, sentence?: string}} Outputs
 * @typedef {{run(values: Float64Array): Outputs | Promise<Outputs>, here?: boolean}} Engine `here`: it is the page that computes
 */

/** The function that a program is, from what gzip packed. @param {Uint8Array} bytes
 * @returns {Promise<(values: Float64Array) => Float64Array[]>} */
export async function programOf(bytes) {
  const text = await new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  return machine(...JSON.parse(text)); // what runs any program stands before the modules
}
