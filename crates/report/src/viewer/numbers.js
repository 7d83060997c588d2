// Numbers as the rest of the page writes them, and colours.

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

/** A number with significant digits, without needless zeros; a power of ten where it is clearer. */
function figures(value, digits = 3) {
  if (!Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const exponent = Math.floor(Math.log10(Math.abs(value)));
  if (exponent >= -3 && exponent < 6) return String(Number(value.toPrecision(digits))).replace("-", "−");
  const power = [...String(exponent)].map((c) => SUPERSCRIPTS[c]).join("");
  return `${figures(value / 10 ** exponent, digits)} × 10${power}`;
}

/** The largest of 1, 2 or 5 times a power of ten that is not above `limit`. */
function roundBelow(limit) {
  const power = 10 ** Math.floor(Math.log10(limit));
  return [5, 2, 1].map((f) => f * power).find((length) => length <= limit) ?? power;
}

/** 256 colours as bytes of red, green, blue and opacity, between those of the map. */
function colorTable(map) {
  const table = new Uint8Array(4 * 256);
  for (let k = 0; k < 256; k++) {
    const place = (k / 255) * (map.length - 1);
    const low = Math.min(Math.floor(place), map.length - 2);
    for (let c = 0; c < 3; c++) table[4 * k + c] = Math.round(map[low][c] + (place - low) * (map[low + 1][c] - map[low][c]));
    table[4 * k + 3] = 255;
  }
  return table;
}

/** The map as a CSS gradient, low at the bottom. */
function cssGradient(map) {
  return `linear-gradient(to top, ${map.map((color) => `rgb(${color.join(" ")})`).join(", ")})`;
}
