// Mouse, fingers and keys.

/** Radians per pixel of a drag, radians and pixels per stroke of a key. */
const TURN = 0.008;
const KEY_TURN = 0.12;
const KEY_MOVE = 30;
/** A press that moves no farther than this is a click [pixels]. */
const CLICK = 4;

class Hands {
  constructor(viewer) {
    this.viewer = viewer;
    this.canvas = viewer.canvas;
    this.pointers = new Map();
    this.travel = 0;
    const on = (event, act) => this.canvas.addEventListener(event, act.bind(this));
    on("pointerdown", this.press);
    on("pointermove", this.move);
    on("pointerup", this.release);
    on("pointercancel", this.release);
    on("pointerleave", () => (element("probe").hidden = true));
    on("contextmenu", (event) => event.preventDefault());
    on("dblclick", this.reset);
    on("keydown", this.key);
    this.canvas.addEventListener("wheel", this.wheel.bind(this), { passive: false });
  }

  press(event) {
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
    if (this.pointers.size === 0) this.travel = 0;
    this.pointers.set(event.pointerId, { x: event.offsetX, y: event.offsetY });
    element("probe").hidden = true;
  }

  move(event) {
    const { viewer } = this;
    const held = this.pointers.get(event.pointerId);
    if (!held) {
      if (event.pointerType === "mouse") this.hover(event.offsetX, event.offsetY);
      return;
    }
    const [dx, dy] = [event.offsetX - held.x, event.offsetY - held.y];
    this.travel += Math.hypot(dx, dy);
    const before = this.spread();
    [held.x, held.y] = [event.offsetX, event.offsetY];
    if (this.pointers.size > 1) {
      const after = this.spread();
      viewer.camera.move(after.x - before.x, before.y - after.y);
      viewer.camera.zoom(after.length / Math.max(before.length, 1), after.x - 0.5 * viewer.width, 0.5 * viewer.height - after.y);
    } else if (event.shiftKey || event.buttons & 6) {
      viewer.camera.move(dx, -dy);
    } else {
      viewer.camera.turn(TURN * dx, -TURN * dy);
    }
    this.touched();
  }

  /** Middle and distance of the fingers. */
  spread() {
    const all = [...this.pointers.values()];
    const [a, b] = [all[0], all[all.length - 1]];
    return { x: 0.5 * (a.x + b.x), y: 0.5 * (a.y + b.y), length: Math.hypot(a.x - b.x, a.y - b.y) };
  }

  release(event) {
    const wasClick = event.type === "pointerup" && event.button === 0 && this.travel <= CLICK && this.pointers.size === 1;
    this.pointers.delete(event.pointerId);
    if (wasClick) this.viewer.keep(event.offsetX, event.offsetY);
  }

  /** At most one look under the pointer a picture. */
  hover(x, y) {
    const isWaiting = this.hovered !== undefined;
    this.hovered = [x, y];
    if (isWaiting) return;
    requestAnimationFrame(() => {
      const [px, py] = this.hovered;
      this.hovered = undefined;
      if (this.pointers.size === 0) this.viewer.probe(px, py);
    });
  }

  wheel(event) {
    // A page that scrolls by must not be caught: the picture zooms once it has been clicked.
    if (document.activeElement !== this.canvas && !event.ctrlKey) return;
    event.preventDefault();
    const lines = event.deltaMode === 1 ? 30 * event.deltaY : event.deltaY;
    const { viewer } = this;
    viewer.camera.zoom(Math.exp(-0.0015 * Math.min(Math.max(lines, -400), 400)), event.offsetX - 0.5 * viewer.width, 0.5 * viewer.height - event.offsetY);
    element("probe").hidden = true;
    this.touched();
  }

  key(event) {
    const { viewer } = this;
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const keys = {
      "+": () => viewer.camera.zoom(1.15),
      "=": () => viewer.camera.zoom(1.15),
      "-": () => viewer.camera.zoom(1 / 1.15),
      ",": () => viewer.show(viewer.frame - 1),
      ".": () => viewer.show(viewer.frame + 1),
      " ": () => (viewer.timer ? viewer.stop() : viewer.body.times.length > 1 && viewer.play()),
      Home: () => this.reset(),
      Escape: () => viewer.forget(),
    };
    const arrow = arrows[event.key];
    if (event.ctrlKey || event.altKey || event.metaKey || !(arrow || keys[event.key])) return;
    event.preventDefault();
    if (arrow && event.shiftKey) viewer.camera.move(KEY_MOVE * arrow[0], KEY_MOVE * arrow[1]);
    else if (arrow) viewer.camera.turn(KEY_TURN * arrow[0], KEY_TURN * arrow[1]);
    else keys[event.key]();
    if (arrow || "+=-".includes(event.key)) this.touched();
  }

  touched() {
    this.viewer.isHome = false;
    this.viewer.redraw();
  }

  reset() {
    this.viewer.forget();
    this.viewer.look("front");
  }
}
