// SPDX-License-Identifier: GPL-3.0-or-later
// usage: node bundle.js BUILD_FOLDER PAGE: one HTML file out of index.html, style.css and src/, with the packages of BUILD_FOLDER.
import { createHash } from "node:crypto";
import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const [folder, page] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const esbuild = createRequire(join(folder, "package.json"))("esbuild");

/** The defaults of all parameters: {stage: {parameter: {value, about}}}, from the text the stages print. */
function parameterDefaults(text) {
  const stages = {};
  let stage = null;
  let about = "";
  for (const line of text.split("\n")) {
    const comment = /^ {2}# (.*)$/.exec(line);
    const block = /^([a-z_]+):/.exec(line);
    const value = /^ {2}([a-z0-9_]+): (.*)$/.exec(line);
    if (comment) {
      about = comment[1];
    } else if (block) {
      stages[block[1]] = stage = {};
    } else if (value && stage) {
      stage[value[1]] = { value: value[2], about };
    }
  }
  return stages;
}

function bundled(entry, options) {
  const result = esbuild.buildSync({
    entryPoints: [join(here, entry)],
    bundle: true,
    minify: true,
    write: false,
    target: "es2022",
    charset: "utf8",
    legalComments: "inline",
    nodePaths: [join(folder, "node_modules")],
    ...options,
  });
  return result.outputFiles[0].text.trim();
}

const sha256 = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const defaults = parameterDefaults(readFileSync(join(folder, "defaults.yaml"), "utf8"));
const script = bundled("src/main.js", { format: "iife", define: { PARAMETER_DEFAULTS: JSON.stringify(defaults) } }).replaceAll(
  "</script",
  "<\\/script",
);
const style = bundled("style.css", {});
// Nothing is loaded from anywhere; `connect-src 'self'` is for `make view`, which serves the page.
const policy = [
  "default-src 'none'",
  `script-src ${sha256(script)}`,
  `style-src ${sha256(style)}`,
  "img-src data: blob:",
  "connect-src 'self'",
  "base-uri 'none'",
  "form-action 'none'",
].join("; ");
const parts = { policy, style: `<style>${style}</style>`, script: `<script>${script}</script>` };
const html = readFileSync(join(here, "index.html"), "utf8").replace(/<!--(policy|style|script)-->/g, (_, part) => parts[part]);
writeFileSync(`${page}.new`, html.replace("%policy%", () => policy));
renameSync(`${page}.new`, page);
