// The viewer: what is shown, and what the reader does with it.

class Viewer {
  constructor(scene, codes) {
    this.openings = scene.openings;
    this.bodies = scene.bodies.map((told) => new Body(told, codes));
    this.canvas = element("canvas");
    this.table = colorTable(scene.map);
    this.painter = new Painter(this.canvas, this.table);
    this.picker = new Picker();
    this.camera = new Camera(scene.view, this.bodies[0].middle);
    this.depth = Math.max(
      ...this.bodies.map((body) => {
        const away = Math.hypot(...body.middle.map((x, k) => x - this.camera.middle[k]));
        return 1.1 * (Math.hypot(...body.step.map((step) => 0.5 * 65534 * step)) + away) + (body.diameter ?? 0);
      }),
    );
    // Particles hide each other: at first their half towards the eye is taken away.
    this.cuts = new Map(this.bodies.map((body) => [body, body.isSurface ? 0 : 50]));
    this.body = this.bodies[0];
    this.field = this.body.fields[0];
    this.frame = this.body.times.length - 1;
    this.mark = null;
    this.isHome = true;
    this.isDue = false;
    fillMenu(element("field"), this.bodies);
    element("map").style.background = cssGradient(scene.map);
    element("missing").hidden = true;
    element("root").hidden = false;
    this.listen();
    this.choose(0, 0);
  }

  listen() {
    const on = (name, event, act) => element(name).addEventListener(event, act);
    on("field", "change", (event) => this.choose(...event.target.value.split(" ").map(Number)));
    on("cut", "input", (event) => {
      this.cuts.set(this.body, Number(event.target.value));
      this.redraw();
    });
    on("frame", "input", (event) => {
      this.stop();
      this.show(Number(event.target.value));
    });
    on("play", "click", () => (this.timer ? this.stop() : this.play()));
    for (const button of document.querySelectorAll("[data-view]")) button.addEventListener("click", () => this.look(button.dataset.view));
    this.canvas.addEventListener("webglcontextlost", (event) => event.preventDefault());
    this.canvas.addEventListener("webglcontextrestored", () => {
      this.painter = new Painter(this.canvas, this.table);
      this.redraw();
    });
    new ResizeObserver(() => this.resize()).observe(this.canvas);
    new Hands(this);
  }

  /** Shows a field of a body, at the time there was before. */
  choose(bodyIndex, fieldIndex) {
    const time = this.body.times[this.frame];
    this.stop();
    this.body = this.bodies[bodyIndex];
    this.field = this.body.fields[fieldIndex];
    element("cut").value = this.cuts.get(this.body);
    element("frame").max = this.body.times.length - 1;
    element("time").hidden = this.body.times.length < 2;
    showBar(this.field);
    this.mark = this.mark?.body === this.body ? this.mark : null;
    this.show(this.body.nearestFrame(time));
  }

  show(frame) {
    if (!this.body.isSurface && frame !== this.frame) this.mark = null;
    this.frame = Math.min(Math.max(frame, 0), this.body.times.length - 1);
    const time = this.body.times[this.frame];
    const clock = `${figures(time, 4)} s`;
    element("frame").value = this.frame;
    element("frame").setAttribute("aria-valuetext", clock);
    element("clock").textContent = clock;
    const title = this.field?.title ?? "Shape";
    const place = this.body.name === "Blood" ? " in the blood" : this.field?.name === "Pressure" ? " at the wall" : "";
    element("title").textContent = title + place;
    element("gap").hidden = !this.field || !this.body.values16(this.field, this.frame).includes(MISSING);
    element("when").textContent = this.field?.of_cycle ? `of the last whole cycle before ${clock}` : `at ${clock}`;
    this.canvas.setAttribute("aria-label", `The vessel in three dimensions: ${element("title").textContent} ${element("when").textContent}`);
    showTimeInCharts(time);
    element("probe").hidden = true;
    this.redraw();
  }

  play() {
    const still = () => this.frame === this.body.times.length - 1;
    if (still()) this.show(0);
    element("play").textContent = "Pause";
    element("play").setAttribute("aria-pressed", "true");
    // All of it in about five seconds, then from the start.
    const pause = Math.max(5000 / this.body.times.length, 40);
    this.timer = setInterval(() => this.show(still() ? 0 : this.frame + 1), pause);
  }

  stop() {
    clearInterval(this.timer);
    this.timer = null;
    element("play").textContent = "Play";
    element("play").setAttribute("aria-pressed", "false");
  }

  look(view) {
    this.isHome = view === "front";
    this.camera.look(view, this.width, this.height, (right, up) => [this.extent(right), this.extent(up)]);
    this.redraw();
  }

  /** The least and the largest extent of the body in this frame along a direction, from what the camera turns about [m]. */
  extent(axis) {
    const place = this.body.places16(this.frame);
    const base = dot(axis, plus(this.body.low, scaled(this.camera.middle, -1)));
    const [x, y, z] = axis.map((part, k) => part * this.body.step[k]);
    let [least, largest] = [Infinity, -Infinity];
    for (let p = 0; p < place.length; p += 3) {
      const along = x * place[p] + y * place[p + 1] + z * place[p + 2];
      if (along < least) least = along;
      if (along > largest) largest = along;
    }
    return place.length ? [base + least, base + largest] : [base, base];
  }

  /** Depth before which nothing is seen [m]. */
  cut() {
    const part = this.cuts.get(this.body) / 100;
    if (part === 0) return 1e9;
    const [least, largest] = this.extent(this.camera.axes[2]);
    return largest - part * (largest - least);
  }

  resize() {
    const [width, height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    if (!width || !height) return;
    const before = this.width;
    [this.width, this.height] = [width, height];
    this.density = Math.min(window.devicePixelRatio || 1, 2);
    this.canvas.width = Math.round(width * this.density);
    this.canvas.height = Math.round(height * this.density);
    if (this.isHome || !before) this.look("front");
    else this.camera.resize(width / before);
    // Drawn at once, as a canvas of a new size is empty; what was asked for meanwhile is then done.
    this.draw();
  }

  redraw() {
    if (this.isDue || !this.width) return;
    this.isDue = true;
    requestAnimationFrame(() => this.isDue && this.draw());
  }

  draw() {
    this.isDue = false;
    const { canvas, camera, density, depth, painter } = this;
    const look = { camera, density, depth, width: canvas.width, height: canvas.height };
    painter.clear(canvas.width, canvas.height);
    painter.draw(this.body, this.frame, { ...look, field: this.field, cut: this.cut() });
    const wall = this.bodies.find((body) => body.isSurface);
    if (wall && wall !== this.body) {
      painter.draw(wall, wall.nearestFrame(this.body.times[this.frame]), { ...look, cut: 1e9, isGhost: true });
    }
    showRuler(this.width, camera.scale);
    showNames(this.openings, camera, this.width, this.height);
    this.showMark();
  }

  /** What lies at a place of the picture, in pixels from its upper left. */
  pick(x, y) {
    return this.picker.pick(this.body, this.frame, this.camera, this.cut(), x - 0.5 * this.width, 0.5 * this.height - y);
  }

  /** Tells the value under the pointer. */
  probe(x, y) {
    const found = this.field && this.pick(x, y);
    const label = element("probe");
    label.hidden = !found;
    if (!found) return;
    label.textContent = withUnit(this.body.value(this.field, this.frame, found.points, found.weights), this.field);
    const left = x + 14 + label.offsetWidth < this.width ? x + 14 : x - 14 - label.offsetWidth;
    label.style.left = `${left}px`;
    label.style.top = `${Math.max(y - 28, 4)}px`;
  }

  /** Keeps the place under the pointer, or forgets the one kept where nothing is. */
  keep(x, y) {
    const found = this.pick(x, y);
    this.mark = found && { body: this.body, ...found };
    this.redraw();
  }

  forget() {
    this.mark = null;
    this.redraw();
  }

  showMark() {
    const mark = element("mark");
    mark.hidden = !this.mark;
    if (!this.mark) return;
    const { points, weights } = this.mark;
    const corners = points.map((point) => this.body.position(this.frame, point));
    const place = [0, 1, 2].map((k) => corners.reduce((sum, corner, c) => sum + weights[c] * corner[k], 0));
    const [x, y] = this.camera.toEye(place);
    mark.style.left = `${0.5 * this.width + x}px`;
    mark.style.top = `${0.5 * this.height - y}px`;
    const value = this.field ? `${this.field.short} ${withUnit(this.body.value(this.field, this.frame, points, weights), this.field)}` : "";
    const at = place.map((x) => figures(1e3 * x, 4)).join(", ");
    element("mark-text").textContent = `${value} at (${at}) mm`.trim();
  }
}
