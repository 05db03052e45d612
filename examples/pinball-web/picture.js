// The picture of the table by three.js: a mesh for each collider, and the ball as an `InstancedMesh`.

import * as THREE from "three";

import { roleOf } from "./table.js";

/** Height of the playfield: the ball, in the plane z = 0, lies on it [m]. */
const FLOOR = -0.0135;
/** Middle and size of the table, and radius of its arch, with the walls [m]. */
const MIDDLE = new THREE.Vector3(0.025, 0.46, 0);
const SIZE = { width: 0.6, height: 0.92, arch: 0.295 };
/** Pixels of the painted playfield for a metre. */
const FINENESS = 1200;
/** The part of the window's height or width that the table fills. */
const FILLS = 0.84;
/** The plunger: its place, and the way that it is drawn back [m]. */
const PLUNGER = { x: 0.28, top: 0.04, length: 0.11, way: 0.035 };
/** A light that is hit loses half its brightness in this time [ms]. */
const HALF_LIFE = 90;

export class Picture {
  #scene = new THREE.Scene();
  #camera = new THREE.PerspectiveCamera(32, 1, 0.05, 10);
  #before = new Float32Array(16);
  #after = new Float32Array(16);
  #time = performance.now();

  constructor(canvas, table) {
    const { world } = table;
    this.table = table;
    this.world = world;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.toneMapping = THREE.ACESFilmicToneMapping;
    this.#scene.background = new THREE.Color(0x0c0f18);
    this.#light();
    this.#scene.add(playfield());
    this.meshes = world.colliders.map((collider, number) => meshOf(collider, roleOf(number)));
    this.#scene.add(...this.meshes);
    this.flippers = this.meshes.slice(0, 2).map((mesh) => ({ mesh, before: undefined }));
    const paint = new THREE.MeshStandardMaterial({
      color: 0xe8edf2,
      metalness: 1,
      roughness: 0.18,
    });
    this.balls = shaded(
      new THREE.InstancedMesh(new THREE.SphereGeometry(1, 48, 32), paint, world.count),
    );
    this.plunger = shaded(plunger());
    paint.envMapIntensity = 2.5;
    this.#scene.add(this.balls, this.plunger);
    this.keepPlaces();
    addEventListener("resize", () => this.#fit());
    this.#fit();
  }

  #light() {
    const sun = new THREE.DirectionalLight(0xfff1dc, 2.6);
    sun.position.set(-0.35, 0.85, 1.1);
    sun.target.position.copy(MIDDLE);
    sun.castShadow = true;
    sun.shadow.mapSize.set(2048, 2048);
    sun.shadow.normalBias = 0.002;
    sun.shadow.radius = 3;
    Object.assign(sun.shadow.camera, { left: -0.6, right: 0.6, top: 0.6, bottom: -0.6, far: 3 });
    this.#scene.add(sun, sun.target, new THREE.HemisphereLight(0xbfd4ff, 0x30241a, 0.7));
    const room = new THREE.PMREMGenerator(this.renderer).fromScene(lamps());
    this.#scene.environment = room.texture;
    this.#scene.environmentIntensity = 0.55;
  }

  /** Looks at the whole table from the player's side, in windows of any form. */
  #fit() {
    const { innerWidth: width, innerHeight: height } = window;
    this.renderer.setSize(width, height, false);
    const camera = this.#camera;
    camera.aspect = width / height;
    const half = Math.tan(THREE.MathUtils.degToRad(camera.fov / 2));
    const distance = Math.max(SIZE.height, SIZE.width / camera.aspect) / (2 * half * FILLS);
    camera.up.set(0, 0, 1);
    camera.position.set(MIDDLE.x, MIDDLE.y - 0.5 * distance, 0.95 * distance);
    // The score is above the table.
    camera.lookAt(MIDDLE.x, MIDDLE.y + 0.02, 0);
    camera.updateProjectionMatrix();
  }

  /** Keeps the places before a step, from which the picture leads to those after it. */
  keepPlaces() {
    this.world.writeMatrices(this.#before);
    const poses = this.table.flipperPoses;
    this.flippers.forEach((flipper, number) => (flipper.before = poseOf(poses[number])));
  }

  /** Lights a bumper, slingshot or target. */
  flash(number) {
    const mesh = this.meshes[number];
    if (mesh.userData.lamp) mesh.userData.lamp.emissiveIntensity = 2.2;
  }

  /** Draws the places a part of a step after those that were kept; `pull` is the part of the plunger's way. */
  draw(part, pull) {
    this.#moveBall(part);
    const poses = this.table.flipperPoses;
    this.flippers.forEach(({ mesh, before }, number) => {
      const after = poseOf(poses[number]);
      mesh.position.lerpVectors(before.position, after.position, part);
      mesh.quaternion.slerpQuaternions(before.rotation, after.rotation, part);
    });
    this.plunger.position.y = PLUNGER.top - 0.5 * PLUNGER.length - PLUNGER.way * pull;
    this.#dim();
    this.renderer.render(this.#scene, this.#camera);
  }

  #moveBall(part) {
    this.world.writeMatrices(this.#after);
    const [before, after] = [this.#before, this.#after];
    // A new ball does not fly in from the drain.
    const way = Math.hypot(after[12] - before[12], after[13] - before[13]);
    const share = way < 0.1 ? part : 1;
    const shown = this.balls.instanceMatrix;
    after.forEach((value, i) => (shown.array[i] = before[i] + share * (value - before[i])));
    shown.needsUpdate = true;
    this.balls.computeBoundingSphere();
  }

  #dim() {
    const now = performance.now();
    const left = 0.5 ** ((now - this.#time) / HALF_LIFE);
    this.#time = now;
    for (const { userData } of this.meshes) {
      if (userData.lamp) userData.lamp.emissiveIntensity *= left;
    }
  }
}

/** Returns place and rotation in the types of three.js. */
function poseOf({ position, rotation }) {
  return {
    position: new THREE.Vector3(...position),
    rotation: new THREE.Quaternion(...rotation).normalize(),
  };
}

/** Returns the mesh of a collider: what it collides with, and rings and lamps for the eye. */
function meshOf(collider, role) {
  const [r, g, b] = collider.color ?? [0.6, 0.6, 0.6];
  const paint = new THREE.MeshStandardMaterial({ roughness: 0.45 });
  paint.color.setRGB(r, g, b, THREE.SRGBColorSpace);
  const mesh = shaded(new THREE.Mesh(geometryOf(collider.shape, role), paint));
  const { position, rotation } = poseOf(collider);
  mesh.position.copy(position);
  mesh.quaternion.copy(rotation);
  if (role === "target") mesh.position.z = FLOOR;
  if (role === "bumper") mesh.add(ring(collider.shape.sphere.radius));
  if (["bumper", "slingshot", "target"].includes(role)) {
    paint.emissive.copy(paint.color);
    paint.emissiveIntensity = 0;
    mesh.userData.lamp = paint;
  }
  mesh.visible = role !== "drain";
  return mesh;
}

function geometryOf({ box, sphere, capsule, rectangle }, role) {
  if (box) return new THREE.BoxGeometry(...box.size);
  if (capsule) return new THREE.CapsuleGeometry(capsule.radius, capsule.length, 12, 32);
  if (rectangle) return new THREE.BoxGeometry(rectangle.sizeX, 0.002, rectangle.sizeZ);
  // A ball rolls over a target: only its place is drawn.
  if (role === "target")
    return new THREE.CylinderGeometry(sphere.radius, sphere.radius, 0.003, 32).rotateX(Math.PI / 2);
  return new THREE.SphereGeometry(sphere.radius, 48, 32);
}

/** Returns a white ring about a bumper of this radius. */
function ring(radius) {
  const paint = new THREE.MeshStandardMaterial({ color: 0xf3ead7, roughness: 0.3 });
  const mesh = shaded(new THREE.Mesh(new THREE.TorusGeometry(0.9 * radius, 0.004, 16, 48), paint));
  mesh.position.z = 0.45 * radius;
  return mesh;
}

function plunger() {
  const paint = new THREE.MeshStandardMaterial({ color: 0xb9c2cc, metalness: 0.9, roughness: 0.3 });
  const rod = new THREE.Mesh(new THREE.CylinderGeometry(0.006, 0.006, PLUNGER.length, 24), paint);
  const knob = new THREE.Mesh(new THREE.SphereGeometry(0.013, 24, 16), paint);
  const tip = new THREE.Mesh(new THREE.CylinderGeometry(0.012, 0.012, 0.008, 24), paint);
  knob.position.y = -0.5 * PLUNGER.length;
  tip.position.y = 0.5 * PLUNGER.length - 0.004;
  rod.position.x = PLUNGER.x;
  return rod.add(knob, tip);
}

/** Returns the board under the ball, painted within the arch. */
function playfield() {
  const texture = new THREE.CanvasTexture(painting());
  texture.colorSpace = THREE.SRGBColorSpace;
  texture.anisotropy = 8;
  const board = new THREE.Mesh(
    new THREE.PlaneGeometry(SIZE.width, SIZE.height),
    new THREE.MeshStandardMaterial({ map: texture, roughness: 0.8, envMapIntensity: 0.15 }),
  );
  board.position.set(MIDDLE.x, MIDDLE.y, FLOOR);
  board.receiveShadow = true;
  return board;
}

function painting() {
  const canvas = document.createElement("canvas");
  const [width, height, arch] = [SIZE.width, SIZE.height, SIZE.arch].map((it) => it * FINENESS);
  [canvas.width, canvas.height] = [width, height];
  const brush = canvas.getContext("2d");
  brush.fillStyle = "#241509";
  brush.fillRect(0, 0, width, height);
  brush.beginPath();
  brush.arc(width / 2, arch, arch, Math.PI, 2 * Math.PI);
  brush.lineTo(width / 2 + arch, height);
  brush.lineTo(width / 2 - arch, height);
  brush.clip();
  const ground = brush.createLinearGradient(0, 0, 0, height);
  ground.addColorStop(0, "#2d5399");
  ground.addColorStop(0.6, "#1d3263");
  ground.addColorStop(1, "#141f3f");
  brush.fillStyle = ground;
  brush.fillRect(0, 0, width, height);
  // Rings about the middle of the bumpers.
  const [x, y] = [width / 2 + (0 - MIDDLE.x) * FINENESS, height / 2 - (0.64 - MIDDLE.y) * FINENESS];
  brush.strokeStyle = "#f2bd4060";
  brush.lineWidth = 5;
  for (let radius = 60; radius < 320; radius += 60) {
    brush.beginPath();
    brush.arc(x, y, radius, 0, 2 * Math.PI);
    brush.stroke();
  }
  return canvas;
}

/** Returns lamps in a dark room, which the ball reflects. */
function lamps() {
  const room = new THREE.Scene();
  room.background = new THREE.Color(0x6a7488);
  for (const [x, y] of [
    [-3, 2],
    [3, 2],
    [0, -3],
  ]) {
    const light = new THREE.MeshBasicMaterial({ color: new THREE.Color(8, 7.5, 6.5) });
    const lamp = new THREE.Mesh(new THREE.BoxGeometry(1.5, 1.5, 0.2), light);
    lamp.position.set(x, y, 4);
    room.add(lamp);
  }
  return room;
}

/** Returns a mesh that casts and receives shadows. */
function shaded(mesh) {
  mesh.traverse((part) => Object.assign(part, { castShadow: true, receiveShadow: true }));
  return mesh;
}
