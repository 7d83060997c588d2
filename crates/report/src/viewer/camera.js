// Where the eye is: a parallel projection, so that lengths in the picture are true.

/** The axes of the views that buttons ask for, as multiples of right, up and toward the eye of the first. */
const VIEWS = {
  front: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
  back: [[-1, 0, 0], [0, 1, 0], [0, 0, -1]],
  side: [[1, 0, 0], [0, 0, 1], [0, -1, 0]],
  end: [[0, 0, -1], [0, 1, 0], [1, 0, 0]],
};

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const scaled = (a, f) => a.map((x) => f * x);
const plus = (a, b) => a.map((x, k) => x + b[k]);
const unit = (a) => scaled(a, 1 / Math.hypot(...a));
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

class Camera {
  /** `view` are the unit vectors right, up and toward the eye, `middle` [m] is what it turns about. */
  constructor(view, middle) {
    this.home = [view.slice(0, 3), view.slice(3, 6), view.slice(6, 9)];
    this.axes = this.home;
    this.middle = middle;
    this.scale = 1; // pixels per metre
    this.shift = [0, 0]; // of the middle from that of the picture, to the right and up [pixels]
    this.version = 0; // grows with each change
  }

  /** Right and up in pixels from the middle of the picture, and toward the eye in metres. */
  toEye(position) {
    const d = plus(position, scaled(this.middle, -1));
    const [right, up, toward] = this.axes;
    return [this.scale * dot(right, d) + this.shift[0], this.scale * dot(up, d) + this.shift[1], dot(toward, d)];
  }

  /** Turns by angles about the vertical and the horizontal of the picture. */
  turn(aboutUp, aboutRight) {
    let [right, up, toward] = this.axes;
    const mixed = (a, b, angle) => plus(scaled(a, Math.cos(angle)), scaled(b, Math.sin(angle)));
    // The vessel turns, so the eye goes the other way.
    toward = mixed(toward, right, -aboutUp);
    up = unit(mixed(up, toward, aboutRight));
    right = unit(cross(up, toward));
    this.axes = [right, up, cross(right, up)];
    this.version++;
  }

  move(right, up) {
    this.shift = [this.shift[0] + right, this.shift[1] + up];
    this.version++;
  }

  /** Zooms about a place of the picture, in pixels right and up of its middle. */
  zoom(factor, x = 0, y = 0) {
    const wanted = Math.min(Math.max(this.scale * factor, 0.2 * this.fitted), 200 * this.fitted);
    const real = wanted / this.scale;
    this.scale = wanted;
    this.shift = [x + real * (this.shift[0] - x), y + real * (this.shift[1] - y)];
    this.version++;
  }

  /** Takes one of the views and fits it to a picture; `extents` gives the ends along right and up [m] about the middle. */
  look(name, width, height, extents) {
    this.axes = VIEWS[name].map((mix) => this.home.map((_, k) => mix.reduce((sum, f, axis) => sum + f * this.home[axis][k], 0)));
    // A picture that is higher than wide shows what is long upright.
    if (height > 1.1 * width && name !== "end") this.axes = [scaled(this.axes[1], -1), this.axes[0], this.axes[2]];
    this.fit(width, height, extents);
  }

  fit(width, height, extents) {
    const [[left, right], [low, high]] = extents(this.axes[0], this.axes[1]);
    // Room at the right for the colour bar, and around for names.
    const bar = Math.min(120, 0.34 * width);
    const room = [Math.max(width - bar - 110, 0.5 * width), Math.max(height - 90, 0.5 * height)];
    this.scale = Math.min(room[0] / Math.max(right - left, 1e-12), room[1] / Math.max(high - low, 1e-12));
    this.fitted = this.scale;
    this.shift = [-0.5 * bar - (this.scale * (left + right)) / 2, (-this.scale * (low + high)) / 2];
    this.version++;
  }

  /** The scale follows the size of the picture. */
  resize(factor) {
    this.scale *= factor;
    this.fitted *= factor;
    this.shift = scaled(this.shift, factor);
    this.version++;
  }
}
