// Draws bodies into the canvas.

class Painter {
  /** Throws where the browser cannot do it. */
  constructor(canvas, table) {
    const gl = canvas.getContext("webgl2", { antialias: true, alpha: true });
    if (!gl) throw new Error("no WebGL 2");
    this.gl = gl;
    this.surface = this.program(SURFACE);
    this.spheres = this.program(SPHERES);
    this.buffers = new Map(); // by place and number of the codes
    this.normals = new Map(); // by body: of the frame drawn last
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA, 256, 1, 0, gl.RGBA, gl.UNSIGNED_BYTE, table);
    for (const [name, value] of [["MIN_FILTER", "LINEAR"], ["MAG_FILTER", "LINEAR"], ["WRAP_S", "CLAMP_TO_EDGE"], ["WRAP_T", "CLAMP_TO_EDGE"]]) {
      gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${name}`], gl[value]);
    }
  }

  program({ vertex, fragment }) {
    const { gl } = this;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program) || "shaders");
    const names = (count, get) => Array.from({ length: gl.getProgramParameter(program, count) }, (_, k) => get(k).name);
    const uniforms = names(gl.ACTIVE_UNIFORMS, (k) => gl.getActiveUniform(program, k));
    const inputs = names(gl.ACTIVE_ATTRIBUTES, (k) => gl.getActiveAttrib(program, k));
    return {
      program,
      at: Object.fromEntries(uniforms.map((name) => [name, gl.getUniformLocation(program, name)])),
      inputs: Object.fromEntries(inputs.map((name) => [name, gl.getAttribLocation(program, name)])),
    };
  }

  /** Empties the picture, which is `width` by `height` pixels. */
  clear(width, height) {
    const { gl } = this;
    gl.viewport(0, 0, width, height);
    gl.clearColor(0, 0, 0, 0);
    gl.depthMask(true);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
  }

  /**
   * Draws a body in a frame. `look` says how: the camera, the size of the picture and its pixels per CSS pixel, the depth that is
   * seen and where the cut is [m], the field that colours the body, and whether it is a ghost.
   */
  draw(body, frame, look) {
    const { gl } = this;
    const { camera, field } = look;
    const { program, at, inputs } = body.isSurface ? this.surface : this.spheres;
    gl.useProgram(program);
    gl.uniform3fv(at.low, body.low);
    gl.uniform3fv(at.pace, body.step);
    gl.uniform3fv(at.middle, camera.middle);
    gl.uniformMatrix3fv(at.axes, false, camera.axes.flat());
    gl.uniform4f(at.frame, camera.scale * look.density, camera.shift[0] * look.density, camera.shift[1] * look.density, look.depth);
    gl.uniform2f(at.size, look.width, look.height);
    gl.uniform1f(at.cut, look.cut);
    gl.uniform1f(at.colored, field ? 1 : 0);
    if (field) {
      const [low, high] = [field.ticks[0].value, field.ticks[field.ticks.length - 1].value];
      gl.uniform2f(at.paint, (field.low - low) / (high - low), field.step / (high - low));
    }
    if (at.ghost !== undefined) gl.uniform1f(at.ghost, look.isGhost ? 1 : 0);
    if (at.diameter !== undefined) gl.uniform1f(at.diameter, body.diameter);

    const bind = (input, buffer, width, type, normalized, stride) => {
      if (input === undefined) return;
      gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
      gl.enableVertexAttribArray(input);
      gl.vertexAttribPointer(input, width, type, normalized, stride, 0);
    };
    bind(inputs.place, this.codes(body.placeOf(frame), body.places16(frame)), 3, gl.UNSIGNED_SHORT, false, 6);
    const values = field ? this.codes(field.values[frame], body.values16(field, frame)) : null;
    if (values) bind(inputs.code, values, 1, gl.UNSIGNED_SHORT, false, 2);
    else if (inputs.code !== undefined) gl.disableVertexAttribArray(inputs.code);
    if (!body.isSurface) {
      gl.drawArrays(gl.POINTS, 0, body.count(frame));
      return;
    }
    bind(inputs.normal, this.normalsOf(body, frame), 3, gl.BYTE, true, 4);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, this.codes(body.triangles[0], body.corners, gl.ELEMENT_ARRAY_BUFFER));
    if (look.isGhost) {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
      gl.depthMask(false);
    }
    gl.drawElements(gl.TRIANGLES, body.corners.length, gl.UNSIGNED_SHORT, 0);
    gl.disable(gl.BLEND);
    gl.depthMask(true);
  }

  /** The buffer of codes that begin at `place`, made at the first call. */
  codes(at, codes, target = this.gl.ARRAY_BUFFER) {
    const place = `${at} ${codes.length}`;
    if (!this.buffers.has(place)) {
      const buffer = this.gl.createBuffer();
      this.gl.bindBuffer(target, buffer);
      this.gl.bufferData(target, codes, this.gl.STATIC_DRAW);
      this.buffers.set(place, buffer);
    }
    return this.buffers.get(place);
  }

  normalsOf(body, frame) {
    const { gl } = this;
    const place = body.placeOf(frame);
    const kept = this.normals.get(body) ?? { buffer: gl.createBuffer(), place: -1 };
    if (kept.place !== place) {
      gl.bindBuffer(gl.ARRAY_BUFFER, kept.buffer);
      gl.bufferData(gl.ARRAY_BUFFER, body.normals(frame), gl.DYNAMIC_DRAW);
      kept.place = place;
      this.normals.set(body, kept);
    }
    return kept.buffer;
  }
}
