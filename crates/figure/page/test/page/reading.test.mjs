// How the page is read: tables, the legend, special points, the tour, fingers, keys, and contrast.

import assert from "node:assert/strict";
import { test } from "node:test";

import { DARK, drawn, LIGHT, meta, open, options, pages } from "./shared.mjs";

const rows = (tab, table, column) => tab.value(`[...document.querySelectorAll("#${table} tbody tr")].map((one) => one.children[${column}].textContent)`);

test("tables are sorted by a press on a head and filtered by words", options, async () => {
    const tab = await open(pages.run);
    const press = (table, head) => tab.value(`[...document.querySelectorAll("#${table} th button")].find((one) => one.textContent.startsWith("${head}")).click()`);
    await press("branches", "points");
    const counts = (await rows(tab, "branches", 4)).map(Number);
    assert.deepEqual(counts, counts.toSorted((a, b) => a - b));
    assert.equal(await tab.value(`document.querySelector("#branches th[aria-sort]").getAttribute("aria-sort")`), "ascending");
    await press("branches", "points");
    assert.deepEqual((await rows(tab, "branches", 4)).map(Number), counts.toReversed());
    const before = await rows(tab, "bifurcations", 2);
    const wanted = before[0].split(",")[0];
    await tab.value(`(() => { const box = document.querySelector("#bifurcations input[type=search]"); box.value = "${wanted}"; box.dispatchEvent(new Event("input")); })()`);
    const kept = await rows(tab, "bifurcations", 2);
    assert.ok(kept.length > 0 && kept.every((event) => event.includes(wanted)));
    assert.deepEqual(tab.complaints, []);
});

test("entries of the legend switch periods and kinds of lines", options, async () => {
    const tab = await open(pages.run);
    const { branches } = await tab.value(meta);
    const drawnBranches = () => tab.value(`Number(document.querySelector(".response").dataset.branches)`);
    const first = branches[0].period;
    const own = branches.filter(({ period, count }) => period === first && count > 0).length;
    const all = await drawnBranches();
    await tab.value(`document.querySelector('[data-layer="period:${first}"]').click()`);
    await drawn(tab);
    assert.equal(await drawnBranches(), all - own);
    assert.equal(await tab.value(`document.querySelector('[data-layer="period:${first}"]').getAttribute("aria-pressed")`), "false");
    await tab.value(`document.querySelector('[data-layer="period:${first}"]').click()`);
    await tab.value(`document.querySelector('[data-layer="unstable"]').click()`);
    await drawn(tab);
    assert.equal(await drawnBranches(), all);
    assert.ok(await tab.value(`hammerbeam.state().off.has("unstable")`));
    assert.deepEqual(tab.complaints, []);
});

test("special points have numbers, and the selected one says how a run starts there", options, async () => {
    const tab = await open(pages.run);
    const numbers = (await rows(tab, "bifurcations", 0)).map(Number);
    assert.ok(numbers.every((number) => number >= 1) && new Set(numbers).size === numbers.length);
    await tab.value(`document.querySelector("#bifurcations tbody button").click()`);
    const words = await tab.value(`document.querySelector("#selected .start").textContent`);
    assert.match(words, new RegExp(`Special point ${numbers[0]}\\..*hammerbeam run STUDY.toml --from results:${numbers[0]} --out NEW`));
    await tab.press("n");
    assert.equal(await tab.value(`hammerbeam.state().numbers`), true);
    await tab.until(`location.hash.includes("numbers=on")`);
    assert.deepEqual(tab.complaints, []);
});

test("the tour goes from place to place and ends", options, async () => {
    const tab = await open(pages.run);
    await tab.press("t");
    const heading = () => tab.value(`document.querySelector("dialog.tour h2")?.textContent ?? ""`);
    const steps = Number(/of (\d+)/.exec(await heading())[1]);
    assert.ok(steps >= 5);
    for (let step = 1; step < steps; step++) {
        assert.ok((await heading()).includes(`${step} of ${steps}`));
        assert.equal(await tab.value(`document.querySelectorAll(".toured").length`), 1);
        await tab.value(`[...document.querySelectorAll("dialog.tour button")].find((one) => /Next|Done/.test(one.textContent)).click()`);
    }
    await tab.value(`[...document.querySelectorAll("dialog.tour button")].find((one) => /Done/.test(one.textContent))?.click()`);
    await tab.until(`document.querySelectorAll("dialog.tour, .toured").length === 0`);
    assert.deepEqual(tab.complaints, []);
});

test("two fingers zoom, one pans, a tap selects", options, async () => {
    const tab = await open(pages.run, "#at=none");
    const box = await tab.value(`(() => { document.querySelector(".response").scrollIntoView(); const { left, top, width, height } = document.querySelector(".response .u-over").getBoundingClientRect(); return { left, top, width, height }; })()`);
    const at = (across, up) => ({ x: box.left + across * box.width, y: box.top + (1 - up) * box.height });
    const touch = (type, points) => tab.send("Input.dispatchTouchEvent", { type, touchPoints: points.map((point, id) => ({ ...point, id })) });
    await touch("touchStart", [at(0.4, 0.5)]);
    await touch("touchStart", [at(0.4, 0.5), at(0.6, 0.5)]);
    for (let step = 1; step <= 5; step++) {
        await touch("touchMove", [at(0.4 - 0.04 * step, 0.5), at(0.6 + 0.04 * step, 0.5)]);
    }
    await touch("touchEnd", []);
    const zoomed = await tab.value(`hammerbeam.state().view`);
    assert.ok(zoomed !== null);
    const width = (view) => view.x[1] - view.x[0];
    const range = pages.run.range[1] - pages.run.range[0];
    assert.ok(width(zoomed) < 0.6 * range && width(zoomed) > 0.15 * range, `${width(zoomed)} of ${range}`);
    await touch("touchStart", [at(0.5, 0.5)]);
    for (let step = 1; step <= 4; step++) {
        await touch("touchMove", [at(0.5 - 0.05 * step, 0.5)]);
    }
    await touch("touchEnd", []);
    const panned = await tab.value(`hammerbeam.state().view`);
    assert.ok(Math.abs(width(panned) - width(zoomed)) < 1e-6 * range && panned.x[0] > zoomed.x[0]);
    await tab.press("0");
    await drawn(tab);
    const [x, y] = await tab.value(`hammerbeam.placeOf(50)`);
    await touch("touchStart", [{ x, y }]);
    await touch("touchEnd", []);
    await tab.until(`hammerbeam.state().selected >= 0`);
    assert.deepEqual(tab.complaints, []);
});

/** Contrasts of all texts with what is behind them that are below 4.5, or below 3 where they are large (WCAG 2.2, 1.4.3). */
const poor = `(() => {
    const parse = (text) => { const [r, g, b, a = 1] = text.match(/[\\d.]+/g).map(Number); return [r, g, b, a]; };
    const over = ([r, g, b, a], under) => [r, g, b].map((part, k) => a * part + (1 - a) * under[k]);
    const linear = (part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4);
    const luminance = (colour) => [0.2126, 0.7152, 0.0722].reduce((sum, weight, k) => sum + weight * linear(colour[k]), 0);
    const behind = (one) => (one === null ? [255, 255, 255] : over(parse(getComputedStyle(one).backgroundColor), behind(one.parentElement)));
    const opacity = (one) => (one === null ? 1 : Number(getComputedStyle(one).opacity) * opacity(one.parentElement));
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const one = walker.currentNode.parentElement;
        if (walker.currentNode.textContent.trim() === "" || one.getClientRects().length === 0 || one.closest("script, style, noscript, :disabled")) continue;
        const style = getComputedStyle(one);
        const under = behind(one);
        const [r, g, b, a] = parse(style.color);
        const [light, dark] = [luminance(over([r, g, b, a * opacity(one)], under)), luminance(under)].sort((x, y) => y - x);
        const size = parseFloat(style.fontSize);
        const isLarge = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
        if ((light + 0.05) / (dark + 0.05) < (isLarge ? 3 : 4.5)) found.push(one.outerHTML.slice(0, 90));
    }
    return found;
})()`;

test("every text stands out from what is behind it as WCAG AA asks, in light and dark", options, async () => {
    for (const features of [LIGHT, DARK]) {
        const tab = await open(pages.run, "", { features });
        await tab.value(`document.querySelector('[data-layer="unstable"]').click()`);
        await drawn(tab);
        assert.deepEqual(await tab.value(poor), []);
        // Lines and marks, also those behind: 3 (1.4.11).
        const { look } = await tab.value(meta);
        const { ink, pale, paper, periods } = features === LIGHT ? look.light : look.dark;
        const luminance = (colour) => [1, 3, 5].map((k) => parseInt(colour.slice(k, k + 2), 16) / 255).map((part) => (part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)).reduce((sum, part, k) => sum + part * [0.2126, 0.7152, 0.0722][k], 0);
        const ratio = (a, b) => { const [light, dark] = [luminance(a), luminance(b)].sort((x, y) => y - x); return (light + 0.05) / (dark + 0.05); };
        assert.ok(ratio(ink, paper) > 7 && ratio(pale, paper) >= 3, `${ratio(pale, paper)}`);
        assert.equal(periods.length, 9);
        for (const colour of periods) assert.ok(ratio(colour, paper) >= 3, `${colour} on ${paper}: ${ratio(colour, paper)}`);
    }
});

test("everything that can be pressed can be reached by Tab", options, async () => {
    const tab = await open(pages.run);
    const counts = await tab.value(`(() => {
        const all = [...document.querySelectorAll("#page button, #page select, #page input")].filter((one) => one.getClientRects().length > 0);
        return [all.length, all.filter((one) => one.tabIndex >= 0 || one.disabled).length, all.filter((one) => one.matches("button") ? one.textContent.trim() === "" : (one.getAttribute("aria-label") ?? one.closest("label")?.textContent ?? "").trim() === "").length];
    })()`);
    assert.equal(counts[1], counts[0]);
    assert.equal(counts[2], 0, "each has a name");
});
