// All tests of the page in one browser, one after the other.

import "./opening.test.mjs";
import "./orbit.test.mjs";
import "./keys.test.mjs";
import "./overlay.test.mjs";
import "./print.test.mjs";
import "./diagram.test.mjs";
import "./compare.test.mjs";
import "./reading.test.mjs";
