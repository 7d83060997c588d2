// The numbers of the page: codes of 16 bits, little-endian, as base64.

/** Code that stands for no value. */
const MISSING = 65535;

function decode(text) {
  let bytes;
  if (Uint8Array.fromBase64) {
    bytes = Uint8Array.fromBase64(text);
  } else {
    const letters = atob(text);
    bytes = new Uint8Array(letters.length);
    for (let k = 0; k < bytes.length; k++) bytes[k] = letters.charCodeAt(k);
  }
  return new Uint16Array(bytes.buffer, 0, bytes.length >> 1);
}

/** A body with its frames. Places are codes; a position is `low + step * code` along each axis. */
class Body {
  constructor(told, codes) {
    Object.assign(this, told);
    this.codes = codes;
    this.isSurface = this.triangles !== undefined;
    this.corners = this.isSurface ? codes.subarray(this.triangles[0], this.triangles[0] + 3 * this.triangles[1]) : null;
    this.middle = this.low.map((low, k) => low + 0.5 * 65534 * this.step[k]);
  }

  /** Where the codes of the positions of a frame begin: equal for frames of equal positions. */
  placeOf(frame) {
    return this.places[frame][0];
  }

  count(frame) {
    return this.places[frame][1];
  }

  places16(frame) {
    const [at, count] = this.places[frame];
    return this.codes.subarray(at, at + 3 * count);
  }

  values16(field, frame) {
    const at = field.values[frame];
    return this.codes.subarray(at, at + this.count(frame));
  }

  /** Position of a point [m]. */
  position(frame, point) {
    const at = this.placeOf(frame) + 3 * point;
    return this.low.map((low, k) => low + this.step[k] * this.codes[at + k]);
  }

  /** Value at a mix of points, NaN where one of them has none. */
  value(field, frame, points, weights) {
    const codes = this.values16(field, frame);
    let sum = 0;
    for (let k = 0; k < points.length; k++) {
      if (codes[points[k]] === MISSING) return NaN;
      sum += weights[k] * codes[points[k]];
    }
    return field.low + field.step * sum;
  }

  /** The frame nearest to a time. */
  nearestFrame(time) {
    let best = 0;
    this.times.forEach((t, k) => {
      if (Math.abs(t - time) < Math.abs(this.times[best] - time)) best = k;
    });
    return best;
  }

  /** Normals of a surface, three signed bytes and a filler a point, by the area of the triangles around. */
  normals(frame) {
    const place = this.places16(frame);
    const [sx, sy, sz] = this.step;
    const sum = new Float32Array(3 * this.count(frame));
    const corners = this.corners;
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const ux = sx * (place[b] - place[a]), uy = sy * (place[b + 1] - place[a + 1]), uz = sz * (place[b + 2] - place[a + 2]);
      const vx = sx * (place[c] - place[a]), vy = sy * (place[c + 1] - place[a + 1]), vz = sz * (place[c + 2] - place[a + 2]);
      const nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
      for (const p of [a, b, c]) {
        sum[p] += nx;
        sum[p + 1] += ny;
        sum[p + 2] += nz;
      }
    }
    const bytes = new Int8Array(4 * this.count(frame));
    for (let p = 0, q = 0; p < sum.length; p += 3, q += 4) {
      const length = Math.hypot(sum[p], sum[p + 1], sum[p + 2]) || 1;
      for (let k = 0; k < 3; k++) bytes[q + k] = Math.round((127 * sum[p + k]) / length);
    }
    return bytes;
  }
}
