// Elements. Texts are set as text, never as markup.

/** An element with attributes and children (elements or texts). */
export function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    node.setAttribute(key, value === true ? "" : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** A number with about four figures. */
export function figures(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size < 1e-3 || size >= 1e6)) return value.toExponential(digits - 2);
  const before = size < 1 ? 1 : Math.floor(Math.log10(size)) + 1;
  const text = value.toFixed(Math.max(0, Math.min(4, digits - before)));
  return text.replace("-", "−");
}

/** A time in milliseconds. */
export function milliseconds(time) {
  if (time === null || time === undefined) return "–";
  return `${(time * 1e3).toFixed(1).replace("-", "−")} ms`;
}
