// Masses in motion along a line, with what joins them and what they hit, on a canvas. Positive displacements
// go to the right.

import type { Stop, Structure } from "./data";
import { EDGE, joinedOf, layoutOf, namesOf, WALL, type Joined, type Layout } from "./mass_layout";
import { carrierOf, type Pose } from "./motion";
import { dashpot, hatched, spring, type Sketch } from "./sketch";

/**
 * Where the masses are, as a share of the height: what lies below them needs more room than what is above.
 */
const MIDDLE = 0.42;
/** How far plates of stops stand over a mass (CSS pixels). */
const OVER = 12;
/** Distance of links that lie below each other (CSS pixels). */
const STEP = 15;

interface Scene extends Sketch {
    layout: Layout;
    middle: number;
    /** Of a mass, or of a wall: -1 is the one on the left. */
    x: (place: number) => number;
    /** Displacement of the walls (CSS pixels). */
    ground: number;
}

/** Draws the structure; returns whether every name is there in full. */
export function drawMasses(sketch: Sketch, structure: Structure, pose: Pose, perMetre: number): boolean {
    const { context, width, height, theme } = sketch;
    const count = structure.places.length;
    const layout = layoutOf(count, width);
    const { rest, spacing, size } = layout;
    const middle = MIDDLE * height;
    const moved = structure.ground === null ? 0 : (pose.supports[structure.ground] ?? 0);
    const ground = Math.max(-EDGE, Math.min(EDGE, perMetre * moved));
    const x = (place: number): number => (rest[place] ?? 0) + perMetre * (pose.places[place] ?? 0);
    const scene = { ...sketch, layout, middle, x, ground };
    const joined = joinedOf(structure.links, count);
    hatched(sketch, [EDGE + ground, middle - 60, WALL, 120], theme.look.ink);
    if (joined.some(({ to }) => to === count)) {
        hatched(sketch, [width - WALL - EDGE + ground, middle - 60, WALL, 120], theme.look.ink);
    }
    context.lineWidth = 1.4;
    const held = Math.max(0, ...joined.filter(({ kind }) => kind === "held").map(({ levels }) => levels));
    for (const one of joined) {
        context.strokeStyle = theme.look.ink;
        (one.kind === "direct" ? drawDirect : one.kind === "held" ? drawHeld : drawFar)(scene, one, held);
    }
    for (const stop of structure.stops) {
        drawStop(scene, stop, pose, perMetre);
    }
    context.font = "12px system-ui, sans-serif";
    context.textAlign = "center";
    const names = structure.places.map(({ name }) => name);
    const shown = namesOf(names, spacing, (text) => context.measureText(text).width);
    names.forEach((_, k) => {
        context.fillStyle = theme.period(1);
        context.fillRect(x(k) - size / 2, middle - size / 2, size, size);
        context.fillStyle = theme.look.ink;
        context.fillText(shown[k] ?? "", rest[k] ?? 0, middle - size / 2 - OVER - 6);
    });
    return shown.every((name, k) => name === names[k]);
}

/** Beside the masses: those of one pair share the height of a mass. */
function drawDirect(scene: Scene, { from, to, damper, level, levels }: Joined): void {
    const { layout, middle, ground, width, x } = scene;
    const left = from < 0 ? WALL + EDGE + ground : x(from) + layout.size / 2;
    const right = to === layout.rest.length ? width - WALL - EDGE + ground : x(to) - layout.size / 2;
    const apart = Math.min(16, (0.9 * layout.size) / levels);
    const height = middle + (level - (levels - 1) / 2) * apart;
    const isAtWall = from < 0 || to === layout.rest.length;
    join(scene, damper, left, right, height, layout.spacing - layout.size / (isAtWall ? 2 : 1));
}

/** Below the mass, from a block of its own: lines from the wall would cross all masses before it. */
function drawHeld(scene: Scene, { to, damper, level }: Joined): void {
    const { layout, middle, theme, ground, x } = scene;
    const { spacing, size, rest } = layout;
    const y = middle + size / 2 + OVER + STEP * (level + 0.8);
    const block = Math.min(8, 0.15 * spacing);
    const left = (rest[to] ?? 0) - 0.45 * spacing + ground * Math.min(1, layout.room / EDGE);
    hatched(scene, [left, y - 7, block, 14], theme.look.ink);
    join(scene, damper, left + block, x(to), y, 0.45 * spacing - block);
    leg(scene, x(to), y);
}

/** Below all that, with a leg to each of its masses. */
function drawFar(scene: Scene, { from, to, damper, level, levels }: Joined, held: number): void {
    const { layout, middle, height, x } = scene;
    const top = middle + layout.size / 2 + OVER + STEP * (held + 1);
    const y = top + level * Math.min(STEP, (height - 8 - top) / Math.max(1, levels - 1));
    join(scene, damper, x(from), x(to), y, (to - from) * layout.spacing);
    [from, to].forEach((place) => leg(scene, x(place), y));
}

function leg({ context, layout, middle }: Scene, x: number, y: number): void {
    context.beginPath();
    context.moveTo(x, middle + layout.size / 2);
    context.lineTo(x, y);
    context.stroke();
}

/** * `length`: of the link when all is at rest. */
function join(sketch: Sketch, isDamper: boolean, from: number, to: number, y: number, length: number): void {
    (isDamper ? dashpot : spring)(sketch, from, to, y, length);
}

/**
 * A plate at each level; one that sits on another mass is joined to it.
 *
 * Plates farther away than the next mass, which no motion of this size comes to, stand at its place.
 */
function drawStop({ context, theme, layout, middle }: Scene, stop: Stop, pose: Pose, perMetre: number): void {
    const { rest, spacing, size } = layout;
    const isPressed = pose.pressed[stop.element] === true;
    const carrier = carrierOf(stop, pose);
    const half = size / 2 + OVER;
    const thickness = Math.min(5, 0.2 * spacing);
    for (const { level, above } of stop.levels) {
        const side = above ? 1 : -1;
        const farthest = spacing - size;
        const away = Math.max(-farthest, Math.min(farthest, perMetre * level));
        const at = (rest[stop.place] ?? 0) + side * (size / 2) + away + perMetre * carrier;
        context.fillStyle = context.strokeStyle = isPressed ? theme.period(2) : theme.look.pale;
        context.fillRect(above ? at : at - thickness, middle - half, thickness, 2 * half);
        if (stop.other !== null) {
            context.lineWidth = 2;
            context.beginPath();
            context.moveTo(at, middle + half - 2);
            context.lineTo((rest[stop.other] ?? 0) + perMetre * carrier, middle + half - 2);
            context.lineTo((rest[stop.other] ?? 0) + perMetre * carrier, middle + size / 2);
            context.stroke();
        }
    }
}
