// The spectrum of a periodic series.

/** Amplitudes of the harmonics 1, 2, ... of the samples of one period, up to half their number. */
export function amplitudes(values: Float64Array): Float64Array {
    const count = values.length;
    const found = new Float64Array(Math.max(0, Math.floor((count - 1) / 2)));
    const turn = (2 * Math.PI) / count;
    for (let harmonic = 1; harmonic <= found.length; harmonic++) {
        let [re, im] = [0, 0];
        for (let k = 0; k < count; k++) {
            const angle = turn * ((harmonic * k) % count);
            re += (values[k] ?? 0) * Math.cos(angle);
            im += (values[k] ?? 0) * Math.sin(angle);
        }
        found[harmonic - 1] = (2 * Math.hypot(re, im)) / count;
    }
    return found;
}
