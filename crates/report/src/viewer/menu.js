// The elements around the picture: menu, colour bar, clock, names and marks.

const element = (name) => document.getElementById(`viewer-${name}`);

/** Value with its unit. */
const withUnit = (value, field) => (Number.isNaN(value) ? "no value" : `${figures(value)} ${field.unit}`.trim());

/** Fills the menu with the fields of all bodies; each option is "body field". A body without fields still has its shape. */
function fillMenu(menu, bodies) {
  bodies.forEach((body, b) => {
    const group = bodies.length > 1 ? document.createElement("optgroup") : menu;
    if (group !== menu) {
      group.label = body.name;
      menu.append(group);
    }
    const titles = body.fields.length ? body.fields.map((field) => field.title) : ["Shape"];
    titles.forEach((title, f) => group.append(new Option(title, `${b} ${f}`)));
  });
}

function showBar(field) {
  const map = element("map");
  map.parentElement.hidden = !field;
  map.parentElement.style.display = field ? "" : "none";
  if (!field) return;
  element("quantity").textContent = field.short;
  element("unit").textContent = field.unit;
  const [low, high] = [field.ticks[0].value, field.ticks[field.ticks.length - 1].value];
  map.replaceChildren(
    ...field.ticks.map((tick) => {
      const label = document.createElement("span");
      label.textContent = tick.text;
      label.style.bottom = `${(100 * (tick.value - low)) / (high - low)}%`;
      return label;
    }),
  );
}

/** A bar of round length, about a sixth of the picture. */
function showRuler(width, scale) {
  const length = roundBelow(width / 6 / scale);
  element("ruler").style.width = `${length * scale}px`;
  element("length").textContent = `${figures(1e3 * length)} mm`;
}

/** Names stand beyond their openings, within the picture. */
function showNames(openings, camera, width, height) {
  const names = element("names");
  while (names.children.length < openings.length) names.append(document.createElement("span"));
  openings.forEach((opening, k) => {
    const label = names.children[k];
    label.textContent = opening.name;
    const [x, y] = camera.toEye(opening.center);
    const tip = camera.toEye(plus(opening.center, scaled(opening.normal, opening.radius)));
    const length = Math.hypot(tip[0] - x, tip[1] - y);
    // As far out as the opening is wide, and half of the label besides.
    const out = length > 1e-9 ? [(tip[0] - x) / length, (tip[1] - y) / length] : [0, 0];
    const [w, h] = [0.5 * label.offsetWidth + 6, 0.5 * label.offsetHeight + 4];
    const place = [0.5 * width + x + out[0] * (0.5 * length + w), 0.5 * height - y - out[1] * (0.5 * length + h)];
    const isIn = place[0] > 0 && place[0] < width && place[1] > 0 && place[1] < height;
    label.style.visibility = isIn ? "visible" : "hidden";
    const held = [Math.min(Math.max(place[0], w), width - w), Math.min(Math.max(place[1], h), height - h)];
    label.style.transform = `translate(${held[0]}px, ${held[1]}px) translate(-50%, -50%)`;
  });
}

/** A line at this time in each chart, whose axis is told by the chart. */
function showTimeInCharts(time) {
  for (const chart of document.querySelectorAll("svg[data-time]")) {
    const [start, end, left, right, top, bottom] = chart.dataset.time.split(" ").map(Number);
    let line = chart.querySelector(".now");
    if (!line) {
      line = document.createElementNS(chart.namespaceURI, "line");
      line.setAttribute("class", "now");
      line.setAttribute("y1", top);
      line.setAttribute("y2", bottom);
      chart.append(line);
    }
    const x = left + ((right - left) * (time - start)) / (end - start);
    line.setAttribute("x1", x);
    line.setAttribute("x2", x);
  }
}
