// Draws x + amplitude Re(φ e^{iθ}) on the meshes of the page, every frame, from what driver.py sends.
//
// The shapes of all meshes are the points of one hidden point cloud, mesh after mesh; if they are complex,
// all real parts come before all imaginary ones. Its colours are the vertices'. For each mesh there is a
// hidden node whose position is the mesh's place in that order, its number of vertices and its opacity;
// amplitude, frequency and phase are the position of another.
// A page that has a hidden node of its own for it stands at the phase in that node's position.
// State and failure are in window.__modeviz, where the browser tests read them.
(prefix, cloudName, driverName, heldName) => {
  const PATIENCE = 30; // s: how long a mesh or viser itself may take to appear
  const LONGEST_FRAME = 0.25; // s: a page that was in the background goes on where it was
  const MATTE = { roughness: 0.6, metalness: 0.05 }; // under colours that mean something

  const page = (window.__modeviz ??= {
    weights: { value: [0, 0] },
    phase: 0,
    complete: false, // whether every mesh shows what was sent for it
    sought: null,
    error: null,
  });
  const turn = (page.turn = {}); // after a reconnect the script runs again, and takes over
  const shown = new WeakMap(); // of each mesh's group, what it shows
  const waiting = {}; // s, of each shape that has no mesh to go to yet
  let before = performance.now();
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

  // Writes into the attribute, which is made at the first time; the primitives of a mesh share it.
  function write(attributes, name, values, Attribute) {
    if (attributes[name]) {
      attributes[name].array.set(values);
      attributes[name].needsUpdate = true;
      return;
    }
    const isHalf = values instanceof Uint16Array;
    attributes[name] = new Attribute(values.slice(), 3, !isHalf);
    attributes[name].isFloat16BufferAttribute = isHalf;
  }

  function patch(material) {
    material.onBeforeCompile = (shader) => {
      shader.uniforms.modevizWeights = page.weights;
      const add = (chunk, code) => {
        if (!shader.vertexShader.includes(`#include <${chunk}>`)) fail(`three.js has no ${chunk}`);
        shader.vertexShader = shader.vertexShader.replace(`#include <${chunk}>`, `#include <${chunk}>\n${code}`);
      };
      add("common", "attribute vec3 modevizReal, modevizImaginary; uniform vec2 modevizWeights;");
      add("begin_vertex", "transformed += modevizWeights.x * modevizReal + modevizWeights.y * modevizImaginary;");
      add(
        "color_vertex",
        `#ifdef USE_COLOR
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
  function dress(material, colored, opacity) {
    const { own, skin } = material.userData;
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
    const { points, colors, complex, colored, total, start, count, opacity } = sent;
    const meshes = [];
    group.traverse((object) => object.geometry?.index && meshes.push(object));
    if (!meshes.length || meshes.some((mesh) => mesh.geometry.attributes.position.count !== count)) return false;
    const Attribute = meshes[0].geometry.attributes.position.constructor;
    const last = shown.get(group);
    const attributes = last?.attributes ?? {};
    const part = (array, before) => array.subarray(before + 3 * start, before + 3 * (start + count));
    write(attributes, "modevizReal", part(points, 0), Attribute);
    if (complex) write(attributes, "modevizImaginary", part(points, 3 * total), Attribute);
    else if (!last || last.complex) write(attributes, "modevizImaginary", new Uint16Array(3 * count), Attribute);
    if (colored) write(attributes, "color", part(colors, 0), Attribute);
    for (const mesh of meshes) {
      for (const name in attributes) mesh.geometry.setAttribute(name, attributes[name]);
      if (!mesh.material.userData.own) patch(mesh.material);
      if (last?.colored !== colored || last.opacity !== opacity) dress(mesh.material, colored, opacity);
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
        const [order, count, opacity] = viewer.nodePoseData[node]?.position ?? [0, 0, 0];
        return { name: node.slice(prefix.length), order, count, opacity };
      })
      .filter(({ count }) => count)
      .sort((a, b) => a.order - b.order);
  }

  // Gives every mesh the newest shape that was sent for it; true if one of them changed.
  function applyShapes(viewer, nodes, seconds) {
    const { points, colors } = nodes[cloudName]?.message.props ?? {};
    if (!points) return false;
    const meshes = drivenMeshes(viewer, nodes);
    const total = meshes.reduce((sum, { count }) => sum + count, 0);
    const complex = points.length === 6 * total;
    if (!complex && points.length !== 3 * total) {
      page.complete = false;
      return wait("the shape of a mesh", seconds);
    }
    delete waiting["the shape of a mesh"];
    const colored = colors.length === 3 * total;
    let changed = false;
    let complete = meshes.length > 0;
    let start = 0;
    for (const { name, count, opacity } of meshes) {
      const sent = { points, colors, complex, colored, total, start, count, opacity };
      start += count;
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
    page.complete = complete;
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
  // they show what was sent before they were asked for, in the size asked for, without the background,
  // which is cut to the page's own shape.
  function beforeRender(renderer) {
    if (page.turn !== turn) return;
    try {
      const viewer = window.__viserMutable;
      update(viewer, window.__viserSceneTree.getState(), 0);
      const isPicture = viewer.getRenderRequestState === "capture";
      viewer.backgroundMaterial.visible = !isPicture;
      if (isPicture) {
        ratio ??= renderer.getPixelRatio();
        renderer.setPixelRatio(1);
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
