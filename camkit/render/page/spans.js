// Spans of a quantity, by what its values give: a design that cannot be built, that misses a limit, or that keeps all.

export const REFUSED = 0;
export const MISSED = 1;
export const KEPT = 2;

/** @typedef {{low: number, high: number, kind: number}} Span */

/** Where limits are kept, in words. @param {Span[]} spans @param {(value: number) => string} text
 * @param {boolean} limited whether there are limits */
export function spansInWords(spans, text, limited) {
  const of = (/** @type {number} */ kind) => spans.filter((span) => span.kind === kind)
    .map(({ low, high }) => `from ${text(low)} to ${text(high)}`).join(" and ");
  const kept = of(KEPT), missed = of(MISSED), can = limited ? "all limits kept" : "can be built";
  const first = kept ? `${can} ${kept}` : limited ? "no value keeps all limits" : "no value can be built";
  return missed && !kept ? `${first}; can be built ${missed}` : first;
}
