// What lies under the pointer.

class Picker {
  constructor() {
    this.key = "";
    this.eye = new Float32Array(0);
  }

  /** Points of a frame in the axes of the picture, kept until the view or the frame changes. */
  seen(body, frame, camera) {
    const key = `${body.name} ${body.placeOf(frame)} ${camera.version}`;
    if (key === this.key) return this.eye;
    const count = body.count(frame);
    const place = body.places16(frame);
    this.eye = new Float32Array(3 * count);
    const origin = camera.toEye(body.low);
    const steps = [0, 1, 2].map((k) => {
      const end = camera.toEye(body.low.map((low, axis) => (axis === k ? low + body.step[k] : low)));
      return end.map((x, row) => x - origin[row]);
    });
    for (let p = 0; p < 3 * count; p += 3) {
      for (let row = 0; row < 3; row++) {
        this.eye[p + row] = origin[row] + steps[0][row] * place[p] + steps[1][row] * place[p + 1] + steps[2][row] * place[p + 2];
      }
    }
    this.key = key;
    return this.eye;
  }

  /** The points and weights of what is met first at x to the right and y up of the middle, behind the cut; null where nothing is. */
  pick(body, frame, camera, cut, x, y) {
    const eye = this.seen(body, frame, camera);
    return body.isSurface ? this.triangle(eye, body.corners, cut, x, y) : this.sphere(eye, 0.5 * body.diameter, camera.scale, cut, x, y);
  }

  triangle(eye, corners, cut, x, y) {
    let best = null;
    let nearest = -Infinity;
    for (let t = 0; t < corners.length; t += 3) {
      const a = 3 * corners[t], b = 3 * corners[t + 1], c = 3 * corners[t + 2];
      const ax = eye[a] - x, ay = eye[a + 1] - y, bx = eye[b] - x, by = eye[b + 1] - y, cx = eye[c] - x, cy = eye[c + 1] - y;
      const wa = bx * cy - by * cx, wb = cx * ay - cy * ax, wc = ax * by - ay * bx;
      if (!((wa >= 0 && wb >= 0 && wc >= 0) || (wa <= 0 && wb <= 0 && wc <= 0))) continue;
      const sum = wa + wb + wc;
      if (sum === 0) continue;
      const depth = (wa * eye[a + 2] + wb * eye[b + 2] + wc * eye[c + 2]) / sum;
      if (depth <= nearest || depth > cut) continue;
      nearest = depth;
      best = { points: [corners[t], corners[t + 1], corners[t + 2]], weights: [wa / sum, wb / sum, wc / sum] };
    }
    return best;
  }

  sphere(eye, radius, scale, cut, x, y) {
    const reach = Math.max(radius * scale, 3);
    let best = null;
    let nearest = -Infinity;
    for (let p = 0; p < eye.length; p += 3) {
      const off = ((eye[p] - x) ** 2 + (eye[p + 1] - y) ** 2) / reach ** 2;
      if (off > 1 || eye[p + 2] > cut) continue;
      const depth = eye[p + 2] + radius * Math.sqrt(1 - off);
      if (depth <= nearest) continue;
      nearest = depth;
      best = { points: [p / 3], weights: [1] };
    }
    return best;
  }
}
