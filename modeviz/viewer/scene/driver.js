// Draws x + amplitude Re(φ e^{iθ}) on the meshes of the page, every frame, from what driver.py sends.
//
// A hidden node carries the shapes of all meshes as points, mesh after mesh; if they are complex, all real
// parts come before all imaginary ones. A mesh that moves rigidly has two points there: the displacement of
// its first vertex and its rotation. For each mesh there is a hidden node whose position is the mesh's place
// in that order, the number of its points and its opacity; its orientation is the gain and the power of its
// shade (modeviz/shapes/colors.py) and whether it has one. Amplitude, frequency and phase are the position of
// another.
// A page that has a hidden node of its own for it stands at the phase in that node's position.
// A page with window.__modevizUnseen, which nobody looks at, draws nothing but the pictures it is asked for.
// State and failure are in window.__modeviz, where the browser tests read them.
(prefix, carrierName, driverName, heldName, stops) => {
  const PATIENCE = 30; // s: how long a mesh or viser itself may take to appear
  const LONGEST_FRAME = 0.25; // s: a page that was in the background goes on where it was
  const RIGID = 2; // points of a mesh that moves rigidly
  const MATTE = { roughness: 0.6, metalness: 0.05 }; // under colours that mean something

  const LOOKS = ["colored", "gain", "power", "opacity"];
  const DECLARATIONS = `
    attribute vec3 modevizReal, modevizImaginary;
    uniform vec2 modevizWeights, modevizShade;
    uniform vec3 modevizStops[${stops.length}];
    vec3 modevizColor() {
      float real = dot(modevizReal, modevizReal);
      float imaginary = dot(modevizImaginary, modevizImaginary);
      float mixed = dot(modevizReal, modevizImaginary);
      float difference = real - imaginary;
      float value = modevizShade.x;
      if (modevizShade.y == 1.0)
        value *= sqrt((real + imaginary + sqrt(difference * difference + 4.0 * mixed * mixed)) / 2.0);
      if (modevizShade.y == 2.0) value *= real + imaginary;
      float place = clamp(value, 0.0, 1.0) * ${stops.length - 1}.0;
      vec3 color = modevizStops[0];
      for (int i = 1; i < ${stops.length}; i++)
        color = mix(color, modevizStops[i], clamp(place - float(i - 1), 0.0, 1.0));
      return color;
    }`;

  const page = (window.__modeviz ??= {
    weights: { value: [0, 0] },
    phase: 0,
    nShown: -1, // how many meshes there are, once all show what was sent for them
    sought: null,
    error: null,
  });
  const turn = (page.turn = {}); // after a reconnect the script runs again, and takes over
  const shown = new WeakMap(); // of each mesh's group, what it shows
  const waiting = {}; // s, of each shape that has no mesh to go to yet
  let before = performance.now();
  let received = null; // the shapes as they came
  let points = null; // and as halves
  let ratio = null; // of the page's pixels, while a picture has its own

  function fail(problem) {
    if (page.error) return;
    page.error = String(problem);
    console.error("modeviz: " + page.error);
    const notice = document.createElement("div");
    notice.textContent = "The shapes in this page do not move: " + page.error;
    notice.style.cssText =
      "position:fixed;top:12px;left:50%;transform:translateX(-50%);z-index:10000;padding:8px 14px;" +
      "background:#c2452d;color:#fff;font:13px sans-serif;border-radius:4px;white-space:pre-wrap";
    document.body.append(notice);
  }

  function wait(name, seconds) {
    waiting[name] = (waiting[name] ?? 0) + seconds;
    if (waiting[name] > PATIENCE) fail(`${name} has not appeared`);
  }

  // The weights of the real and the imaginary part now; true if they changed.
  function turnPhase([amplitude, frequency, sought], held, seconds) {
    if (sought !== page.sought) page.phase = page.sought = sought;
    else if (held === undefined) page.phase += 2 * Math.PI * frequency * seconds;
    page.phase %= 2 * Math.PI;
    const phase = held ?? page.phase;
    const weights = [amplitude * Math.cos(phase), -amplitude * Math.sin(phase)];
    const changed = weights.some((weight, i) => weight !== page.weights.value[i]);
    page.weights.value = weights;
    return changed;
  }

  // The halves of points, x y z after x y z, from the bytes of `_packed` in driver.py.
  function unpack(bytes) {
    const n = bytes.length / 6;
    const halves = new Uint16Array(3 * n);
    let bits = 0;
    for (let i = 0; i < 3 * n; i++) {
      bits = (bits + bytes[i] + 256 * bytes[3 * n + i]) & 0xffff;
      halves[3 * (i % n) + Math.floor(i / n)] = bits;
    }
    return halves;
  }

  // Writes into the attribute, which is made at the first time; the primitives of a mesh share it.
  function write(attributes, name, values, Attribute) {
    if (attributes[name]?.array.constructor === values.constructor) {
      attributes[name].array.set(values);
      attributes[name].needsUpdate = true;
      return;
    }
    attributes[name] = new Attribute(values.slice(), 3);
    attributes[name].isFloat16BufferAttribute = values instanceof Uint16Array;
  }

  // The number that has these 16 bits.
  function number(half) {
    const exponent = (half >> 10) & 31;
    const size = exponent ? 2 ** (exponent - 15) * (1 + (half & 1023) / 1024) : (half & 1023) / 2 ** 24;
    return half >> 15 ? -size : size;
  }

  // The displacements u + θ x r of all vertices of a mesh that moves rigidly; r is from its first vertex.
  function spread(points, vertices) {
    const [ux, uy, uz, a, b, c] = Array.from(points, number);
    const shape = new Float32Array(vertices.length);
    for (let i = 0; i < vertices.length; i += 3) {
      const [x, y, z] = [vertices[i] - vertices[0], vertices[i + 1] - vertices[1], vertices[i + 2] - vertices[2]];
      shape[i] = ux + b * z - c * y;
      shape[i + 1] = uy + c * x - a * z;
      shape[i + 2] = uz + a * y - b * x;
    }
    return shape;
  }

  function patch(material) {
    material.userData.shade = { value: [0, 0] };
    material.onBeforeCompile = (shader) => {
      shader.uniforms.modevizWeights = page.weights;
      shader.uniforms.modevizShade = material.userData.shade;
      shader.uniforms.modevizStops = { value: stops.flat() };
      const add = (chunk, code) => {
        if (!shader.vertexShader.includes(`#include <${chunk}>`)) fail(`three.js has no ${chunk}`);
        shader.vertexShader = shader.vertexShader.replace(`#include <${chunk}>`, `#include <${chunk}>\n${code}`);
      };
      add("common", DECLARATIONS);
      add("begin_vertex", "transformed += modevizWeights.x * modevizReal + modevizWeights.y * modevizImaginary;");
      add(
        "color_vertex",
        `#ifdef USE_COLOR
          vColor.rgb = modevizColor();
          vColor.rgb = mix(vColor.rgb / 12.92, pow((vColor.rgb + 0.055) / 1.055, vec3(2.4)), step(0.04045, vColor.rgb));
        #endif`,
      );
    };
    material.customProgramCacheKey = () => "modeviz";
    material.polygonOffset = true; // leaves the edge lines in front of their own surface
    material.polygonOffsetFactor = material.polygonOffsetUnits = 1;
    material.userData.own = {
      color: material.color.clone(),
      opacity: material.opacity,
      roughness: material.roughness,
      metalness: material.metalness,
    };
  }

  // Skin takes the colours and the opacity of its body, glass the opacity; dressing keeps its own. On
  // colours the edges are black.
  function dress(material, { colored, gain, power, opacity }) {
    const { own, skin, shade } = material.userData;
    shade.value = [gain, power];
    if (skin || own.opacity < 1) material.opacity = own.opacity * opacity;
    material.transparent = material.opacity < 1;
    material.depthWrite = !material.transparent;
    if (skin && own.opacity === 1) {
      material.vertexColors = colored;
      Object.assign(material, colored ? MATTE : { roughness: own.roughness, metalness: own.metalness });
      if (colored) material.color.setRGB(1, 1, 1);
      else material.color.copy(own.color);
    }
    if (material.isLineBasicMaterial) material.color.copy(own.color).multiplyScalar(colored ? 0 : 1);
    material.needsUpdate = true;
  }

  // Gives a mesh what was sent for it; true if that is done.
  function apply(group, sent) {
    const { points, complex, total, start, count } = sent;
    const meshes = [];
    group.traverse((object) => object.geometry?.index && meshes.push(object));
    if (!meshes.length) return false;
    const vertices = meshes[0].geometry.attributes.position;
    if (count !== RIGID && meshes.some((mesh) => mesh.geometry.attributes.position.count !== count)) return false;
    const Attribute = vertices.constructor;
    const last = shown.get(group);
    const attributes = last?.attributes ?? {};
    const shape = (before) => {
      const part = points.subarray(before + 3 * start, before + 3 * (start + count));
      return count === RIGID ? spread(part, vertices.array) : part;
    };
    const real = shape(0);
    write(attributes, "modevizReal", real, Attribute);
    if (complex) write(attributes, "modevizImaginary", shape(3 * total), Attribute);
    else if (!last || last.complex || last.count !== count)
      write(attributes, "modevizImaginary", new real.constructor(real.length), Attribute);
    for (const mesh of meshes) {
      for (const name in attributes) mesh.geometry.setAttribute(name, attributes[name]);
      if (!mesh.material.userData.own) patch(mesh.material);
      if (LOOKS.some((look) => last?.[look] !== sent[look])) dress(mesh.material, sent);
      mesh.frustumCulled = false; // it moves out of the bounds it was loaded with
    }
    shown.set(group, { ...sent, attributes });
    return true;
  }

  // The meshes in the order of their shapes.
  function drivenMeshes(viewer, nodes) {
    return Object.keys(nodes)
      .filter((node) => nodes[node] && node.startsWith(prefix + "/"))
      .map((node) => {
        const { position, wxyz } = viewer.nodePoseData[node] ?? { position: [0, 0, 0], wxyz: [] };
        const [order, count, opacity] = position;
        const [gain, power, colored] = wxyz;
        return { name: node.slice(prefix.length), order, count, opacity, gain, power, colored: !!colored };
      })
      .filter(({ count }) => count)
      .sort((a, b) => a.order - b.order);
  }

  // Gives every mesh the newest shape that was sent for it; true if one of them changed.
  function applyShapes(viewer, nodes, seconds) {
    const { shapes } = nodes[carrierName]?.message.props ?? {};
    if (!shapes) return false;
    if (shapes !== received) points = unpack((received = shapes));
    const meshes = drivenMeshes(viewer, nodes);
    const total = meshes.reduce((sum, { count }) => sum + count, 0);
    const complex = points.length === 6 * total;
    if (!complex && points.length !== 3 * total) {
      page.nShown = -1;
      return wait("the shape of a mesh", seconds);
    }
    delete waiting["the shape of a mesh"];
    let changed = false;
    let complete = true;
    let start = 0;
    for (const { name, order, ...looks } of meshes) {
      const sent = { ...looks, points, complex, total, start };
      start += looks.count;
      const group = viewer.nodeRefFromName[name]?.children[0];
      const last = group && shown.get(group);
      if (last && Object.keys(sent).every((key) => last[key] === sent[key])) continue;
      if (group && apply(group, sent)) {
        delete waiting[name];
        changed = true;
      } else {
        complete = false;
        wait(name, seconds);
      }
    }
    page.nShown = complete ? meshes.length : -1;
    return changed;
  }

  // Brings shapes and phase up to what was sent; true if something changed.
  function update(viewer, nodes, seconds) {
    const driver = viewer.nodePoseData[driverName];
    const held = nodes[heldName] && viewer.nodePoseData[heldName]?.position[0];
    const moved = driver ? turnPhase(driver.position, held, seconds) : false;
    return applyShapes(viewer, nodes, seconds) || moved;
  }

  // three.js calls this at the start of every rendering, also of the pictures viser takes between frames:
  // they show what was sent before they were asked for, in the size asked for, as near and as far as the page
  // sees, without the background, which is cut to the page's own shape.
  function beforeRender(renderer, _, camera) {
    if (page.turn !== turn) return;
    try {
      const viewer = window.__viserMutable;
      update(viewer, window.__viserSceneTree.getState(), 0);
      const isPicture = viewer.getRenderRequestState === "capture";
      // A camera that has drawn nothing yet has near and far the other way round, which shadows go by.
      const isNew = renderer.capabilities.reversedDepthBuffer && !viewer.camera.reversedDepth;
      viewer.scene.visible = isPicture || isNew || !window.__modevizUnseen;
      viewer.backgroundMaterial.visible = !isPicture;
      if (isPicture) {
        ratio ??= renderer.getPixelRatio();
        renderer.setPixelRatio(1);
        Object.assign(camera, { near: viewer.camera.near, far: viewer.camera.far });
        camera.updateProjectionMatrix();
      } else if (ratio !== null) {
        renderer.setPixelRatio(ratio);
        ratio = null;
      }
    } catch (error) {
      fail(error.stack ?? error);
    }
  }

  function frame() {
    if (page.turn !== turn) return;
    requestAnimationFrame(frame);
    const now = performance.now();
    const seconds = Math.min((now - before) / 1000, LONGEST_FRAME);
    before = now;
    try {
      const viewer = window.__viserMutable;
      const tree = window.__viserSceneTree;
      if (!viewer?.scene || !tree) return wait("viser's scene", seconds);
      viewer.scene.onBeforeRender = beforeRender;
      if (update(viewer, tree.getState(), seconds)) viewer.requestRender();
    } catch (error) {
      fail(error.stack ?? error);
    }
  }
  frame();
}
