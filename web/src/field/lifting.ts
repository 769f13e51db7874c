// Pebbles that are taken out of the ground, carried about and put back: where each is to be, and its way there.

import { Plane, Quaternion, Vector3, type Mesh, type Object3D, type Ray } from 'three';

interface Lifted {
  mesh: Mesh;
  home: Vector3;
  goal: Vector3;
  /** Radians around the upright, now and to be. */
  turn: number;
  turnGoal: number;
  homeTurn: Quaternion;
  hovering: boolean;
}

const kHaste = 9; // 1/s: how fast what is left of the way gets less
const kTurn = 0.9; // radians that a pebble turns as it comes out
const kNear = 1e-3; // of a pebble's size: there
const kUp = new Vector3(0, 1, 0);

export class Lifting {
  calm = false;
  /** Something stands elsewhere than when this was last set back. */
  changed = false;
  private readonly all = new Map<number, Lifted>();
  private held: { lifted: Lifted; grip: Vector3 | null } | null = null;

  /** `heightAt`: of the ground, or what lies on it, at a place; but for one pebble. */
  constructor(private readonly heightAt: (x: number, z: number, but: Mesh) => number) {}

  /** Out of the ground, or home. */
  press(id: number, mesh: Mesh): void {
    const known = this.all.get(id);
    if (known && !known.goal.equals(known.home)) return this.sendHome(known);
    const home = known?.home ?? mesh.position.clone();
    const goal = home.clone().setY(home.y + 1.7 * sizeOf(mesh));
    const homeTurn = known?.homeTurn ?? mesh.quaternion.clone();
    this.all.delete(id); // the last one moved comes last
    this.all.set(id, { mesh, home, goal, turn: known?.turn ?? 0, turnGoal: kTurn, homeTurn, hovering: true });
  }

  private sendHome(lifted: Lifted): void {
    lifted.goal.copy(lifted.home);
    lifted.turnGoal = 0;
    lifted.hovering = false;
  }

  /** True where it is out and can be carried. */
  grab(id: number): boolean {
    const lifted = this.all.get(id);
    if (!lifted || lifted.goal.equals(lifted.home)) return false;
    this.held = { lifted, grip: null };
    return true;
  }

  /** To where the ray meets the level that it hovers at; `world` is what the pebbles' places are in. */
  drag(ray: Ray, world: Object3D): void {
    if (!this.held) return;
    const { lifted } = this.held;
    if (!lifted.hovering) {
      lifted.hovering = true;
      lifted.goal.y += 1.2 * sizeOf(lifted.mesh);
    }
    const level = new Plane(kUp, -world.localToWorld(lifted.goal.clone()).y);
    const met = ray.intersectPlane(level, new Vector3());
    if (!met) return;
    const at = world.worldToLocal(met);
    this.held.grip ??= lifted.goal.clone().sub(at).setY(0);
    lifted.goal.set(at.x + this.held.grip.x, lifted.goal.y, at.z + this.held.grip.z);
  }

  /** Lets go: it falls home where it is near, else on what lies below. */
  drop(): void {
    if (!this.held) return;
    const { lifted, grip } = this.held;
    this.held = null;
    if (!grip) return;
    const size = sizeOf(lifted.mesh);
    const away = Math.hypot(lifted.goal.x - lifted.home.x, lifted.goal.z - lifted.home.z);
    if (away < 0.5 * size) return this.sendHome(lifted);
    lifted.goal.y = this.heightAt(lifted.goal.x, lifted.goal.z, lifted.mesh) - bottomOf(lifted.mesh);
    lifted.hovering = false;
  }

  settle(): void {
    for (const lifted of this.all.values()) this.sendHome(lifted);
  }

  forget(): void {
    this.all.clear();
    this.held = null;
  }

  /** Those that are not on their way home, the last one first. */
  away(): number[] {
    const ids = [...this.all].filter(([, { goal, home }]) => !goal.equals(home)).map(([id]) => id);
    return ids.reverse();
  }

  /** Moves all by so many seconds; true where there is more to come. */
  step(seconds: number): boolean {
    let going = false;
    const part = this.calm ? 1 : 1 - Math.exp(-kHaste * seconds);
    for (const [id, lifted] of this.all) {
      const { mesh, goal, home, homeTurn } = lifted;
      const far = mesh.position.distanceTo(goal) > kNear * sizeOf(mesh);
      if (far) {
        mesh.position.lerp(goal, part);
        lifted.turn += part * (lifted.turnGoal - lifted.turn);
        mesh.quaternion.setFromAxisAngle(kUp, lifted.turn).multiply(homeTurn);
        this.changed = going = true;
      } else if (goal.equals(home)) {
        mesh.position.copy(home);
        mesh.quaternion.copy(homeTurn);
        this.all.delete(id);
        this.changed = true;
      }
    }
    return going;
  }
}

/** Across its widest, in the units of its place. */
function sizeOf(mesh: Mesh): number {
  if (!mesh.geometry.boundingSphere) mesh.geometry.computeBoundingSphere();
  return 2 * (mesh.geometry.boundingSphere?.radius ?? 0) * mesh.scale.x;
}

function bottomOf(mesh: Mesh): number {
  if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
  return (mesh.geometry.boundingBox?.min.y ?? 0) * mesh.scale.y;
}
