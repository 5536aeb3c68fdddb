// What is done with a pointer on the diagram: wheel, drag, pinch, click.

import { element } from "./dom";

/** A place as shares of width and height, from the lower left corner. */
type Shares = [number, number];

export interface Gestures {
    zoom: (factor: [number, number], about: Shares) => void;
    pan: (by: Shares) => void;
    box: (first: Shares, last: Shares) => void;
    whole: () => void;
    press: () => void;
    choose: (left: number, top: number) => void;
    hover: (place: [left: number, top: number] | null) => void;
}

/** Movement (CSS pixels) up to which a press is a click; a finger is less still. */
const STILL = { mouse: 4, touch: 9 };

export function listenToGestures(over: HTMLElement, act: Gestures): void {
    const shares = (event: { clientX: number; clientY: number }): Shares => {
        const box = over.getBoundingClientRect();
        return [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    };
    const fingers = new Map<number, PointerEvent>();
    over.addEventListener(
        "wheel",
        (event) => {
            event.preventDefault();
            const factor = Math.exp(Math.max(-1, Math.min(1, event.deltaY / 300)));
            act.zoom([event.altKey ? 1 : factor, event.shiftKey ? 1 : factor], shares(event));
        },
        { passive: false },
    );
    over.addEventListener("dblclick", act.whole);
    over.addEventListener("pointerleave", () => act.hover(null));
    over.addEventListener("contextmenu", (event) => event.preventDefault());
    over.addEventListener("pointermove", (event) => {
        if (event.buttons === 0) {
            act.hover([event.offsetX, event.offsetY]);
        }
    });
    over.addEventListener("pointerdown", (down) => {
        over.setPointerCapture(down.pointerId);
        act.press();
        fingers.set(down.pointerId, down);
        if (fingers.size === 1) {
            drag(over, down, shares, fingers, act);
        }
    });
    for (const end of ["pointerup", "pointercancel"] as const) {
        over.addEventListener(end, (event) => fingers.delete(event.pointerId));
    }
    over.addEventListener("pointermove", (event) => {
        if (fingers.has(event.pointerId)) {
            if (fingers.size === 2) {
                pinch([...fingers.values()], event, shares, act);
            }
            fingers.set(event.pointerId, event);
        }
    });
}

/** Two fingers: what lies between them stays between them. */
function pinch(
    before: readonly PointerEvent[],
    event: PointerEvent,
    shares: (event: PointerEvent) => Shares,
    act: Gestures,
): void {
    const [moved, still] = [
        before.find(({ pointerId }) => pointerId === event.pointerId),
        before.find(({ pointerId }) => pointerId !== event.pointerId),
    ];
    if (moved === undefined || still === undefined) {
        return;
    }
    const [fixed, from, to] = [shares(still), shares(moved), shares(event)];
    const distance = (place: Shares): number =>
        Math.max(0.02, Math.hypot(place[0] - fixed[0], place[1] - fixed[1]));
    const factor = distance(from) / distance(to);
    act.zoom([factor, factor], fixed);
}

/**
 * A press that moves zooms into a box, or pans with shift, another button or a finger; one that does not
 * selects.
 */
function drag(
    over: HTMLElement,
    down: PointerEvent,
    shares: (event: PointerEvent) => Shares,
    fingers: ReadonlyMap<number, PointerEvent>,
    act: Gestures,
): void {
    const pans = down.shiftKey || down.button !== 0 || down.pointerType === "touch";
    const box = element("div", { class: "zoom-box" });
    let [moved, pinched, last] = [false, false, shares(down)];
    const first = last;
    const move = (event: PointerEvent): void => {
        pinched ||= fingers.size > 1;
        if (event.pointerId !== down.pointerId || pinched) {
            return;
        }
        moved ||=
            Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) >
            STILL[down.pointerType === "touch" ? "touch" : "mouse"];
        const now = shares(event);
        if (moved && pans) {
            act.pan([last[0] - now[0], last[1] - now[1]]);
            last = now;
        } else if (moved) {
            over.append(box);
            const [left, right] = [Math.min(first[0], now[0]), Math.max(first[0], now[0])];
            const [low, high] = [Math.min(first[1], now[1]), Math.max(first[1], now[1])];
            box.style.cssText =
                `left:${100 * left}%;width:${100 * (right - left)}%;` +
                `top:${100 * (1 - high)}%;height:${100 * (high - low)}%`;
        }
    };
    const up = (event: PointerEvent): void => {
        if (event.pointerId !== down.pointerId) {
            return;
        }
        over.removeEventListener("pointermove", move);
        over.removeEventListener("pointerup", up);
        over.removeEventListener("pointercancel", up);
        box.remove();
        const now = shares(event);
        if (event.type === "pointercancel" || pinched) {
            return;
        }
        if (!moved) {
            act.choose(event.offsetX, event.offsetY);
        } else if (!pans && now[0] !== first[0] && now[1] !== first[1]) {
            act.box(first, now);
        }
    };
    over.addEventListener("pointermove", move);
    over.addEventListener("pointerup", up);
    over.addEventListener("pointercancel", up);
}
