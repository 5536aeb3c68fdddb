// The multipliers of every solution (see multipliers.rs of the figure crate).

import { Unpacker } from "./unpack";

export type Multiplier = [re: number, im: number];

/** Bits of the heads that count the entries of a solution; those above them say which are pairs. */
const COUNT_BITS = 4;

export class MultiplierTable {
    /** How many entries a solution has, and which are pairs. */
    private readonly heads: Uint32Array;
    /** The numbers of all solutions: the first number of each, then the second, and so on. */
    private readonly numbers: Float32Array[] = [];
    /** Where a solution stands among those that have a number. */
    private readonly places: Uint32Array[] = [];

    /** * `bytes`: columns, `solutions`: how many have one. */
    constructor(bytes: Uint8Array<ArrayBuffer>, solutions: number) {
        const columns = new Unpacker(bytes);
        this.heads = columns.whole(solutions, 2);
        const lengths = new Uint8Array(solutions);
        let most = 0;
        for (let solution = 0; solution < solutions; solution++) {
            const length = lengthOf(this.heads[solution] ?? 0);
            lengths[solution] = length;
            most = Math.max(most, length);
        }
        for (let k = 0; k < most; k++) {
            const places = new Uint32Array(solutions);
            let count = 0;
            for (let solution = 0; solution < solutions; solution++) {
                places[solution] = count;
                count += (lengths[solution] ?? 0) > k ? 1 : 0;
            }
            this.places.push(places);
            // Three bytes of a single precision number, the lowest one is not carried.
            this.numbers.push(new Float32Array(columns.whole(count, 3).map((bits) => bits << 8).buffer));
        }
    }

    /** Those that are carried of a solution, largest first, both of a pair. */
    of(solution: number): Multiplier[] {
        const head = this.heads[solution] ?? 0;
        const found: Multiplier[] = [];
        let next = 0;
        const number = (): number => {
            const place = this.places[next]?.[solution] ?? 0;
            return this.numbers[next++]?.[place] ?? NaN;
        };
        for (let k = 0; k < (head & (2 ** COUNT_BITS - 1)); k++) {
            const re = number();
            if (((head >> (COUNT_BITS + k)) & 1) === 1) {
                const im = number();
                found.push([re, im], [re, -im]);
            } else {
                found.push([re, 0]);
            }
        }
        return found;
    }
}

/** How many numbers a solution has. */
function lengthOf(head: number): number {
    let count = head & (2 ** COUNT_BITS - 1);
    for (let left = head >> COUNT_BITS; left > 0; left >>= 1) {
        count += left & 1;
    }
    return count;
}
