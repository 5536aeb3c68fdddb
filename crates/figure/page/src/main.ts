import { Curves } from "./curves";
import { readMeta, readSolutions } from "./data";
import { fromHash } from "./hash";
import { Response } from "./response";
import { Store } from "./state";
import { Theme } from "./theme";

const meta = readMeta();
const solutions = readSolutions(meta.branches);
const curves = new Curves(solutions);
const store = new Store(fromHash(location.hash, meta, curves.spansMuch("displacement")));
const theme = new Theme(meta, store);
const page = document.getElementById("page") ?? document.body;
new Response(meta, solutions, curves, store, theme, page);
