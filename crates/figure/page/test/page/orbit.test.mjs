// The orbit of a solution, its multipliers, the structure in motion.

import assert from "node:assert/strict";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { drawn, isSeen, meta, motion, open, options, orbitIsOpen, pages, pictures, rich } from "./shared.mjs";

test("a click opens the orbit of the solution, and its peaks are those of the store", options, async () => {
    const tab = await open(pages.run);
    const { orbits, branches } = await tab.value(meta);
    const wanted = orbits.solutions.filter((solution) => solution > branches[0].first + 50)[20];
    const [x, y] = await tab.value(`hammerbeam.placeOf(${wanted})`);
    await tab.click(x, y);
    await tab.until(orbitIsOpen);
    const selected = await tab.value(`hammerbeam.state().selected`);
    const [toX, toY] = await tab.value(`hammerbeam.placeOf(${selected})`);
    assert.ok(Math.hypot(toX - x, toY - y) <= 1.5, "the solution clicked on");
    await tab.value(`location.hash = "#at=${pages.run.first_branch}:${wanted - branches[0].first}"`);
    await tab.until(`document.querySelector(".solution").dataset.orbit === "${wanted}"`);
    const compared = await tab.value(`(() => {
        const orbit = hammerbeam.orbit();
        const most = (values) => Math.max(0, ...values.map(Math.abs));
        // In SI: of "1.2 kN" 1200.
        const sizes = { G: 1e9, M: 1e6, k: 1e3, m: 1e-3, µ: 1e-6, n: 1e-9 };
        const inSi = (text) => parseFloat(text.replace("−", "-")) * (sizes[/ ([GMkmµn])(?=[mNJ])/.exec(text)?.[1]] ?? 1);
        const numbers = [...document.querySelectorAll(".numbers dd")].map((one) => inSi(one.textContent));
        const names = [...document.querySelectorAll(".numbers dt")].map((one) => one.textContent);
        const of = (name) => numbers[names.indexOf(name)];
        return {
            displacement: [most([...orbit.displacement]), of("Max. displacement")],
            acceleration: [most([...orbit.acceleration]), of("Max. acceleration")],
            force: [Math.max(0, ...orbit.forces.map((force) => most([...force]))), of("Max. contact force")],
        };
    })()`);
    // 192 samples miss a peak by (pi/192)^2/2 = 1.3e-4 of it and more for higher harmonics; 24 in a contact by 2e-3.
    for (const [name, [found, stored]] of Object.entries(compared)) {
        assert.ok(Math.abs(found - stored) <= 0.01 * stored, `${name}: ${found} of ${stored}`);
    }
    if (pictures !== "") {
        writeFileSync(join(pictures, "page-light.png"), await tab.picture());
    }
    assert.deepEqual(tab.complaints, []);
});

test("displacement and velocity are drawn where a simulation has them, to half a pixel", options, async () => {
    const { branches } = await (await open(pages.run)).value(meta);
    assert.ok(pages.run.courses.length > 0);
    for (const { solution, course } of pages.run.courses) {
        const { id, first } = branches.findLast((branch) => branch.count > 0 && branch.first <= solution);
        const tab = await open(pages.run, `#at=${id}:${solution - first}`);
        await tab.until(`document.querySelector(".solution").dataset.orbit === "${solution}"`);
        const { line, velocity, period } = await tab.value(`(() => { const { course, velocity, period } = hammerbeam.orbit(); return { line: course.map((values) => [...values]), velocity: [...velocity], period }; })()`);
        const range = (values) => Math.max(...values) - Math.min(...values);
        const [times, displacement] = line;
        course.forEach(([meant, speed], j) => {
            const time = j / course.length;
            const behind = times.findIndex((instant) => instant > time);
            const share = (time - times[behind - 1]) / (times[behind] - times[behind - 1]);
            const found = displacement[behind - 1] + share * (displacement[behind] - displacement[behind - 1]);
            // The plot over the time has 210 pixels, the phase plane with the samples of the velocity 300.
            const pixels = [(210 * (found - meant)) / range(displacement)];
            const place = (time * velocity.length) / period;
            if (Number.isInteger(place)) {
                pixels.push((300 * (velocity[place] - speed)) / range(velocity));
            }
            assert.ok(pixels.every((off) => Math.abs(off) < 0.5), `${pixels} pixels at ${time} of solution ${solution}`);
        });
        assert.deepEqual(tab.complaints, []);
    }
});

test("multipliers are those of the selected solution, whether its orbit is carried or not", options, async () => {
    const tab = await open(pages.run);
    const { orbits, branches } = await tab.value(meta);
    const carried = new Set(orbits.solutions);
    const without = pages.run.multipliers.filter(({ solution }) => !carried.has(solution));
    assert.ok(without.length > 20);
    const near = (found, stored, tolerance) => Math.abs(found - stored) <= tolerance * Math.abs(stored);
    for (const { solution, stored } of pages.run.multipliers) {
        const found = await tab.value(`hammerbeam.multipliersOf(${solution})`);
        assert.equal(found.length, stored.length);
        const sorted = (all) => all.map(([re, im]) => [re, Math.abs(im)]);
        sorted(found).forEach(([re, im], k) => {
            const [storedRe, storedIm] = sorted(stored)[k];
            // An f32 without its lowest byte.
            assert.ok(near(re, storedRe, 2 ** -15) && near(im, storedIm, 2 ** -15), `${solution}: ${re} ${im} of ${stored[k]}`);
        });
    }
    // What is read on the page, of a solution whose orbit is not carried.
    const { solution, stored } = without[10];
    const place = branches.findLast(({ first, count }) => count > 0 && first <= solution);
    await tab.value(`location.hash = "#at=${place.id}:${solution - place.first}"`);
    await tab.until(`hammerbeam.state().selected === ${solution}`);
    const read = await tab.value(`[...document.querySelectorAll("#multipliers li")].map((one) => one.textContent)`);
    const parts = read[0].replaceAll("−", "-").replace("i", "").split(" ± ").map(Number);
    assert.ok(near(parts[0], stored[0][0], 1e-3) && near(parts[1] ?? 0, Math.abs(stored[0][1]), 1e-3), `${read[0]} of ${stored[0]}`);
    const whose = await tab.value(`document.querySelector("#multipliers .note").textContent`);
    assert.ok(whose.includes("of the selected solution, at "), whose);
    assert.deepEqual(tab.complaints, []);
});

test("the structure moves, and stands still when it is paused", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    await tab.until(orbitIsOpen);
    const first = await tab.value(motion);
    await tab.until(`${motion} !== ${JSON.stringify(first)}`);
    await tab.press(" ");
    await tab.until(`[...document.querySelectorAll("#motion button")].some((one) => one.textContent === "Play")`);
    await drawn(tab);
    const paused = await tab.value(motion);
    await new Promise((resolve) => setTimeout(resolve, 300));
    assert.ok((await tab.value(motion)) === paused);
    assert.deepEqual(tab.complaints, []);
});

test("the unit circle stays one, and whole, when the window changes and on paper", options, async () => {
    const tab = await open(pages.run, `#at=${pages.run.first_branch}:100`);
    await tab.until(orbitIsOpen);
    const check = async (where) => {
        await drawn(tab);
        await drawn(tab);
        const [across, up] = await tab.value(`hammerbeam.unitCircle()`);
        assert.ok(up > 10 && Math.abs(across - up) < 1.5, `${across} across, ${up} up ${where}`);
        const halves = await tab.value(`(() => { const { width, height } = document.querySelector("#multipliers .u-over").getBoundingClientRect(); const density = document.querySelector("#multipliers canvas").width / document.querySelector("#multipliers canvas").getBoundingClientRect().width; return [width, height].map((size) => 0.5 * size * density); })()`);
        assert.ok(across < halves[0] && up < halves[1], `a radius of ${across} in a frame of ${halves} ${where}`);
    };
    for (const width of [1400, 700, 1110, 420, 320]) {
        await tab.send("Emulation.setDeviceMetricsOverride", { width, height: 900, deviceScaleFactor: 1, mobile: false });
        await check(`at ${width} pixels`);
    }
    await tab.value(`window.dispatchEvent(new Event("beforeprint"))`);
    await check("on paper");
    assert.deepEqual(tab.complaints, []);
});

test("no corner is seen in the phase portraits of orbits of several periods", options, async () => {
    const { orbits, branches } = await (await open(pages.run)).value(meta);
    const several = branches.filter(({ period, count }) => period > 1 && count > 0);
    assert.ok(several.length > 0);
    for (const { id, first, count, period } of several) {
        const own = orbits.solutions.filter((solution) => solution >= first && solution < first + count);
        for (const solution of [own[0], own[own.length >> 1]]) {
            const tab = await open(pages.run, `#at=${id}:${solution - first}`);
            await tab.until(`document.querySelector(".solution").dataset.orbit === "${solution}"`);
            // How far the curve through three points leaves the line between two of them: an eighth of the second difference.
            const farthest = await tab.value(`(() => {
                const [displacement, velocity] = hammerbeam.orbit().portrait;
                const n = displacement.length;
                const width = (values) => Math.max(...values) - Math.min(...values);
                const bend = (values) => (k) => (values[k] - 2 * values[(k + 1) % n] + values[(k + 2) % n]) / width(values) / 8;
                const [across, up] = [bend(displacement), bend(velocity)];
                return Math.max(...Array.from({ length: n }, (_, k) => Math.hypot(across(k), up(k))));
            })()`);
            // Three pixels of a hundred; without the samples within contacts it is twelve.
            assert.ok(farthest < 0.03, `${farthest} of the size of the portrait of solution ${solution}, period ${period}`);
        }
    }
});

test("an orbit is read as it was written, to half a step of its rounding", options, async () => {
    const tab = await open(rich, "#at=7:0");
    await tab.until(orbitIsOpen);
    const orbit = await tab.value(`(() => {
        const { displacement, velocity, acceleration, support, forces, modes, spectrum, impulses } = hammerbeam.orbit();
        const plain = (values) => [...values];
        return { displacement: plain(displacement), velocity: plain(velocity), acceleration: plain(acceleration), support: plain(support), forces: forces.map(plain), modes: modes.map(plain), spectrum: plain(spectrum), impulses };
    })()`);
    // As crates/cli/tests/page.rs makes it.
    const wave = (count, size) => Array.from({ length: count }, (_, k) => size * Math.cos((2 * Math.PI * k) / count));
    const twice = (values) => values.flatMap((value) => [value, value]);
    const near = (found, meant, tolerance) => {
        assert.equal(found.length, meant.length);
        found.forEach((value, k) => assert.ok(Math.abs(value - meant[k]) <= tolerance, `${value} of ${meant[k]}`));
    };
    // Half of a 1023rd of the range, 511th of that of the largest mode; a size of steps may be longer by 2^-7.
    const half = (range, steps = 1023) => (0.51 * range) / steps;
    near(orbit.displacement, wave(60, 1e-3), half(2e-3));
    near(orbit.velocity, wave(60, 1), half(2));
    near(orbit.acceleration, twice(wave(60, 10)), half(20));
    near(orbit.support, wave(12, 2e-4), half(4e-4));
    near(orbit.forces[0], twice(wave(60, 1)), half(2));
    near(orbit.forces[1], twice(wave(60, 0)), 0);
    near(orbit.modes[0], wave(30, 1e-3), half(2e-3, 511));
    near(orbit.modes[1], wave(30, -5e-4), half(2e-3, 511));
    near(orbit.spectrum, [1, -4, -4], 0.0101);
    const [{ element, cycles, impulse, velocity }] = orbit.impulses;
    assert.deepEqual([element, cycles, impulse, velocity], [1, 0.25, -0.125, [0.75, -0.5]]);
    assert.deepEqual(tab.complaints, []);
});

test("impacts on rigid stops are stems with their size, and a gap in the phase portrait", options, async () => {
    const tab = await open(rich, "#at=7:0");
    await tab.until(orbitIsOpen);
    const gaps = `hammerbeam.orbit().portrait.map((values) => [...values].filter(Number.isNaN).length)`;
    assert.deepEqual(await tab.value(gaps), [1, 1]);
    assert.ok((await tab.value(`document.querySelector("#impulse").innerText`)).includes("One impact: 0.1250 N s."));
    assert.deepEqual([await tab.value(isSeen("#force canvas")), await tab.value(isSeen("#impulse canvas"))], [true, true]);
    // Where no force acts over a time there is none to draw.
    await tab.value(`location.hash = "#at=7:1"`);
    await tab.until(`document.querySelector(".solution").dataset.orbit === "1"`);
    assert.deepEqual([await tab.value(isSeen("#force canvas")), await tab.value(isSeen("#impulse canvas"))], [false, true]);
    assert.ok((await tab.value(`document.querySelector("#impulse").innerText`)).includes("5 impacts: together 0.6250 N s, the largest 0.1250 N s."));
    assert.deepEqual(tab.complaints, []);
});
