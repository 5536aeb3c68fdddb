// The multipliers of every solution (see multipliers.rs of the figure crate).

import { bytesOf } from "./base64";

export type Multiplier = [re: number, im: number];

export class MultiplierTable {
    private readonly bytes: Uint8Array<ArrayBuffer>;
    /** Where the record of each solution begins. */
    private readonly offsets: Uint32Array;

    /** * `text`: the records in base64. */
    constructor(text: string, solutions: number) {
        this.bytes = bytesOf(text);
        this.offsets = new Uint32Array(solutions);
        let at = 0;
        for (let k = 0; k < solutions; k++) {
            this.offsets[k] = at;
            const { entries, pairs } = this.head(at);
            at += 2 + 3 * (entries + ones(pairs));
        }
    }

    /** Those that are carried of a solution, largest first, both of a pair. */
    of(solution: number): Multiplier[] {
        const begin = this.offsets[solution];
        if (begin === undefined) {
            return [];
        }
        const { entries, pairs } = this.head(begin);
        let at = begin + 2;
        const view = new DataView(new ArrayBuffer(4));
        const number = (): number => {
            const [low, middle, high] = this.bytes.subarray(at, at + 3);
            at += 3;
            view.setUint32(0, ((high ?? 0) << 24) | ((middle ?? 0) << 16) | ((low ?? 0) << 8));
            return view.getFloat32(0);
        };
        const found: Multiplier[] = [];
        for (let k = 0; k < entries; k++) {
            const re = number();
            if (((pairs >> k) & 1) === 1) {
                const im = number();
                found.push([re, im], [re, -im]);
            } else {
                found.push([re, 0]);
            }
        }
        return found;
    }

    private head(at: number): { entries: number; pairs: number } {
        const head = (this.bytes[at] ?? 0) | ((this.bytes[at + 1] ?? 0) << 8);
        return { entries: head & 15, pairs: head >> 4 };
    }
}

function ones(bits: number): number {
    let count = 0;
    for (let left = bits; left > 0; left >>= 1) {
        count += left & 1;
    }
    return count;
}
