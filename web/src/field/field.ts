// The stones of a run in three dimensions, from the bytes of the very GLB that is offered as a file. Nothing is drawn
// while nothing moves.

import {
  Box3,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Mesh,
  MeshStandardMaterial,
  PCFShadowMap,
  PerspectiveCamera,
  PlaneGeometry,
  Raycaster,
  Scene,
  Spherical,
  Vector2,
  Vector3,
  WebGLRenderer,
  type Object3D,
  type Texture,
} from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { Lifting } from './lifting';
import { listen } from './listen';

export interface FieldLook {
  texture: boolean;
  wireframe: boolean;
  /** Where the light comes from, turned from the photo's left and top, radians. */
  light: number;
  accent: string;
  ground: string;
  /** No animations. */
  calm: boolean;
}

export interface FieldEvents {
  /** The pebble under the pointer. */
  pointed(id: number | null): void;
  /** Pebbles that lie somewhere else than where they were found, the last one moved first. */
  lifted(ids: readonly number[]): void;
  lost(): void;
}

const kSide = 10; // of the field's longer side as it is drawn, whatever its metres are
const kMostPixels = 2; // device px of a CSS px; more are not seen
const kView = new Vector3(0, 1.5, 0.8); // from where the field is seen at first
const kSun = new Vector2(-0.8, -0.25); // x and z of the light: the photo's left, a little its top
const kPlain = '#bdb5a8';
const kShadowSide = 2048; // px
const kPlainShadowSide = 1024;

export class Field {
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly camera = new PerspectiveCamera(36, 1, 0.05, 200);
  private readonly controls: OrbitControls;
  private readonly sun = new DirectionalLight('#fff4e2', 3.4);
  private readonly ray = new Raycaster();
  /** Scaled, so that all that is below it may be in metres. */
  private readonly world = new Group();
  private readonly lifting: Lifting;
  private readonly silence: () => void;
  private look: FieldLook | null = null;
  private model: Object3D | null = null;
  private pebbles = new Map<number, Mesh>();
  private chosen: number | null = null;
  private chosenMaterial: MeshStandardMaterial | null = null;
  private size = new Vector2(1, 1); // of the ground as it is drawn
  private frame = 0;
  private before = 0;
  private newest = 0;

  /** Throws where the browser has no WebGL2. `plain`: for a processor that has to draw. */
  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly plain: boolean,
    private readonly events: FieldEvents,
  ) {
    this.renderer = new WebGLRenderer({ canvas, antialias: !plain, alpha: true });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFShadowMap;
    this.renderer.shadowMap.autoUpdate = false;
    this.lifting = new Lifting((x, z, but) => this.heightAt(x, z, but));
    this.silence = listen(canvas, {
      pick: (x, y) => this.pick(x, y),
      press: (id) => this.press(id),
      grab: (id) => this.grab(id),
      drag: (x, y) => this.drag(x, y),
      drop: () => this.drop(),
      point: (id) => this.events.pointed(id),
    });
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.maxPolarAngle = 0.49 * Math.PI;
    this.controls.minDistance = 0.4;
    this.controls.maxDistance = 60;
    this.controls.addEventListener('change', () => this.invalidate());
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.setScalar(plain ? kPlainShadowSide : kShadowSide);
    this.sun.shadow.normalBias = 0.01;
    this.sun.shadow.bias = -0.0004;
    this.scene.add(this.world, this.sun, this.sun.target, new HemisphereLight('#dfe9f5', '#8a7d6b', 2));
    canvas.addEventListener('webglcontextlost', this.onLost);
  }

  private readonly onLost = () => this.events.lost();

  /** A run's stones in the place of those before. How many there are that can be lifted. */
  async show(glb: ArrayBuffer): Promise<number> {
    const mine = ++this.newest;
    const { scene } = await new GLTFLoader().parseAsync(glb, '');
    if (mine !== this.newest) {
      free(scene);
      return this.pebbles.size;
    }
    this.clear();
    this.model = scene;
    this.world.add(scene);
    const pebbles: [number, Mesh][] = [];
    scene.traverse((object) => {
      object.visible &&= !object.name.includes('convcolonly'); // shapes for physics, not to be seen
      const id = /^pebble-(\d+)$/.exec(object.name)?.[1];
      if (object instanceof Mesh && id && !('isInstancedMesh' in object)) pebbles.push([Number(id), object]);
    });
    this.pebbles = new Map(pebbles);
    this.measure(scene);
    if (!scene.getObjectByName('ground')) scene.add(this.plainGround(scene));
    scene.traverse((object) => {
      object.castShadow = !isGround(object);
      object.receiveShadow = true;
    });
    this.dress();
    this.invalidate();
    return this.pebbles.size;
  }

  /** Scales the world to the field; the camera stays where it is for another run on the same photo. */
  private measure(scene: Object3D): void {
    this.world.scale.setScalar(1);
    this.world.updateMatrixWorld(true);
    const box = new Box3().setFromObject(scene.getObjectByName('ground') ?? scene);
    const extent = box.getSize(new Vector3());
    const scale = kSide / Math.max(extent.x, extent.z, 1e-9);
    this.world.scale.setScalar(scale);
    this.world.updateMatrixWorld(true);
    const size = new Vector2(extent.x, extent.z).multiplyScalar(scale);
    const other = size.distanceTo(this.size) > 0.05 * kSide;
    this.size = size;
    if (other) this.fit();
  }

  private plainGround(scene: Object3D): Mesh {
    const box = new Box3().setFromObject(scene);
    const extent = box.getSize(new Vector3()).divideScalar(this.world.scale.x).multiplyScalar(1.04);
    const centre = box.getCenter(new Vector3()).divideScalar(this.world.scale.x);
    const ground = new Mesh(new PlaneGeometry(extent.x || 1, extent.z || 1), new MeshStandardMaterial());
    ground.name = 'ground';
    ground.rotation.x = -Math.PI / 2;
    ground.position.set(centre.x, 0, centre.z);
    return ground;
  }

  setLook(look: FieldLook): void {
    this.look = look;
    this.lifting.calm = look.calm;
    this.controls.enableDamping = !look.calm;
    this.dress();
    this.invalidate();
  }

  /** Materials and light as they were asked for. */
  private dress(): void {
    const { look, model } = this;
    if (!look || !model) return;
    this.chosenMaterial?.dispose();
    this.chosenMaterial = null;
    for (const [material, ground] of materialsOf(model)) {
      const own = (material.userData['own'] ??= ownOf(material)) as Own;
      material.map = look.texture ? own.map : null;
      material.normalMap = look.texture ? own.normalMap : null;
      const plain = ground ? look.ground : kPlain;
      material.color.set(own.map && look.texture ? '#ffffff' : plain);
      material.wireframe = look.wireframe && !ground;
      material.needsUpdate = true;
    }
    this.mark();
    const { x, y: z } = kSun.clone().rotateAround(new Vector2(), look.light);
    this.sun.position.set(x, 1.15, z).multiplyScalar(kSide);
    const { camera: shadow } = this.sun.shadow;
    [shadow.left, shadow.right, shadow.bottom, shadow.top] = [-0.75, 0.75, -0.75, 0.75].map((v) => v * kSide) as Four;
    shadow.far = 4 * kSide;
    shadow.updateProjectionMatrix();
    this.renderer.shadowMap.needsUpdate = true;
  }

  /** The pebble that the keys act on, or that was chosen in the photo. */
  choose(id: number | null): void {
    if (this.chosen === id) return;
    this.chosen = id;
    this.mark();
    this.invalidate();
  }

  /** The one after it in reading order, or before. */
  chooseNext(step: number): number | null {
    const ids = [...this.pebbles.keys()];
    const at = this.chosen === null ? -1 : ids.indexOf(this.chosen);
    const next = at < 0 ? (step > 0 ? 0 : ids.length - 1) : (at + step + ids.length) % ids.length;
    this.choose(ids[next] ?? null);
    return this.chosen;
  }

  private mark(): void {
    for (const [id, mesh] of this.pebbles) {
      const plain = (mesh.userData['material'] ??= mesh.material) as MeshStandardMaterial;
      if (id !== this.chosen) mesh.material = plain;
      else mesh.material = this.chosenMaterial ??= marked(plain, this.look?.accent ?? '#1d5a96');
    }
  }

  /** Takes it out of the ground, or puts it back where it was found. */
  press(id: number | null = this.chosen): void {
    const mesh = id === null ? undefined : this.pebbles.get(id);
    if (id === null || !mesh) return;
    this.lifting.press(id, mesh);
    this.moved();
  }

  private grab(id: number): boolean {
    const held = this.lifting.grab(id);
    this.controls.enabled = !held;
    return held;
  }

  private drag(x: number, y: number): void {
    this.aim(x, y);
    this.lifting.drag(this.ray.ray, this.world);
    this.moved();
  }

  private drop(): void {
    this.controls.enabled = true;
    this.lifting.drop();
    this.moved();
  }

  /** Every one back where it was found. */
  settle(): void {
    this.lifting.settle();
    this.moved();
  }

  private moved(): void {
    this.events.lifted(this.lifting.away());
    this.invalidate();
  }

  private aim(x: number, y: number): void {
    const { clientWidth, clientHeight } = this.canvas;
    this.ray.setFromCamera(new Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight), this.camera);
  }

  private pick(x: number, y: number): number | null {
    this.aim(x, y);
    const hit = this.ray.intersectObjects([...this.pebbles.values()], false)[0];
    return hit ? Number(hit.object.name.slice('pebble-'.length)) : null;
  }

  /** How high the ground, or what lies on it, is at a place of the model, but for one of the pebbles. */
  private heightAt(x: number, z: number, but: Mesh): number {
    const from = this.world.localToWorld(new Vector3(x, 0, z)).setY(2 * kSide);
    this.ray.set(from, new Vector3(0, -1, 0));
    const others = [...this.pebbles.values()].filter((mesh) => mesh !== but);
    const hit = this.ray.intersectObjects(others, false)[0];
    return hit ? this.world.worldToLocal(hit.point.clone()).y : 0;
  }

  fit(): void {
    const half = (this.camera.fov * Math.PI) / 360;
    const across = Math.atan(Math.tan(half) * this.camera.aspect);
    const direction = kView.clone().normalize();
    // The nearer edge is seen larger than the middle, and the farther one higher up.
    const depth = 0.5 * this.size.y * direction.y + 0.5 * this.size.y * direction.z * Math.tan(half);
    const width = 0.5 * this.size.x;
    const distance = Math.max(depth / Math.tan(half), width / Math.tan(across) + 0.5 * this.size.y * direction.z);
    this.controls.target.set(0, 0, 0);
    this.camera.position.copy(direction.multiplyScalar(1.05 * distance));
    this.controls.update();
    this.invalidate();
  }

  zoom(factor: number): void {
    const offset = this.camera.position.clone().sub(this.controls.target).divideScalar(factor);
    offset.clampLength(this.controls.minDistance, this.controls.maxDistance);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.invalidate();
  }

  /** Around the middle, radians. */
  turn(around: number, up: number): void {
    const way = new Spherical().setFromVector3(this.camera.position.clone().sub(this.controls.target));
    way.theta += around;
    way.phi = Math.min(this.controls.maxPolarAngle, Math.max(0.02, way.phi + up));
    this.camera.position.copy(this.controls.target).add(new Vector3().setFromSpherical(way));
    this.controls.update();
    this.invalidate();
  }

  resize(width: number, height: number, ratio: number): void {
    if (width < 1 || height < 1) return;
    this.renderer.setPixelRatio(this.plain ? 1 : Math.min(ratio, kMostPixels));
    this.renderer.setSize(width, height, false);
    const fitted = this.camera.aspect;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (Math.abs(fitted - this.camera.aspect) > 0.01) this.fit();
    this.invalidate();
  }

  private invalidate(): void {
    if (!this.frame) this.frame = requestAnimationFrame(this.draw);
  }

  private readonly draw = (now: number) => {
    this.frame = 0;
    const going = this.lifting.step(Math.min(0.05, (now - this.before) / 1000));
    this.before = now;
    if (going || this.lifting.changed) this.renderer.shadowMap.needsUpdate = true;
    this.lifting.changed = false;
    this.controls.update(); // asks for another frame as long as it coasts
    this.renderer.render(this.scene, this.camera);
    if (going) this.invalidate();
  };

  private clear(): void {
    if (!this.model) return;
    this.lifting.forget();
    this.events.lifted([]);
    for (const mesh of this.pebbles.values()) mesh.material = mesh.userData['material'] ?? mesh.material;
    this.pebbles.clear();
    this.chosen = null;
    this.chosenMaterial?.dispose();
    this.chosenMaterial = null;
    this.world.remove(this.model);
    free(this.model);
    this.model = null;
  }

  /** Gives back all that the graphics card holds. */
  dispose(): void {
    ++this.newest;
    cancelAnimationFrame(this.frame);
    this.canvas.removeEventListener('webglcontextlost', this.onLost);
    this.silence();
    this.controls.dispose();
    this.clear();
    this.sun.dispose();
    this.renderer.dispose();
    this.renderer.forceContextLoss();
  }
}

type Four = [number, number, number, number];

interface Own {
  map: Texture | null;
  normalMap: Texture | null;
}

const ownOf = ({ map, normalMap }: MeshStandardMaterial): Own => ({ map, normalMap });
const isGround = (object: Object3D) => object.name === 'ground';

/** Each once, and whether it is the ground's. */
function materialsOf(model: Object3D): Map<MeshStandardMaterial, boolean> {
  const materials = new Map<MeshStandardMaterial, boolean>();
  model.traverse((object) => {
    if (!(object instanceof Mesh)) return;
    const material = (object.userData['material'] ?? object.material) as MeshStandardMaterial;
    materials.set(material, isGround(object));
  });
  return materials;
}

function marked(material: MeshStandardMaterial, accent: string): MeshStandardMaterial {
  const copy = material.clone();
  copy.emissive = new Color(accent);
  copy.emissiveIntensity = 0.55;
  return copy;
}

function free(model: Object3D): void {
  for (const [material] of materialsOf(model)) {
    const { map, normalMap } = (material.userData['own'] as Own | undefined) ?? ownOf(material);
    for (const texture of new Set([map, normalMap, material.roughnessMap])) {
      (texture?.source.data as ImageBitmap | undefined)?.close?.();
      texture?.dispose();
    }
    material.dispose();
  }
  model.traverse((object) => object instanceof Mesh && object.geometry.dispose());
}
