// Puts the package together in dist/: the engine that CMake has built, what it says of itself (techniques, parameters and
// their types), and the compiled sources.
import { execFileSync } from 'node:child_process';
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { fileURLToPath } from 'node:url';
import { compile } from 'json-schema-to-typescript';

const here = fileURLToPath(new URL('.', import.meta.url));
const engine = `${here}dist/engine`;
const builds = { threads: 'wasm-release', single: 'wasm-release-single' };

/** What a package has to say of its own licence, and of the libraries that the engine holds. */
function copyLicences() {
  copyFileSync(`${here}../../LICENSE`, `${here}LICENSE`);
  copyFileSync(`${here}../../packaging/copyright`, `${here}NOTICE`);
}

function copyEngine() {
  rmSync(`${here}dist`, { recursive: true, force: true });
  mkdirSync(engine, { recursive: true });
  writeFileSync(`${engine}/package.json`, '{ "type": "commonjs" }\n');
  for (const [variant, preset] of Object.entries(builds)) {
    const from = `${here}../../build/${preset}/bin/tessera-${variant}`;
    const endings = variant === 'threads' ? ['js', 'wasm', 'worker.js'] : ['js', 'wasm'];
    for (const ending of endings) copyFileSync(`${from}.${ending}`, `${engine}/tessera-${variant}.${ending}`);
    // The same script as a module, for import() in browsers; the threads' workers load the plain one.
    const script = readFileSync(`${from}.js`, 'utf8');
    writeFileSync(`${engine}/tessera-${variant}.mjs`, `${script}\nexport default createTesseraModule;\n`);
  }
}

async function loadEngine() {
  const wasmBinary = readFileSync(`${engine}/tessera-single.wasm`);
  return createRequire(import.meta.url)(`${engine}/tessera-single.js`)({ wasmBinary });
}

/** A source that is not kept in the repository. */
const write = (name, text) =>
  writeFileSync(`${here}src/${name}.ts`, `// Made from the core by build.mjs; not kept in the repository.\n\n${text}`);

/** One interface a technique: PavementParameters. */
async function writeParameterTypes(core) {
  const schema = JSON.parse(core.schema());
  const texts = Object.entries(schema.$defs).map(([technique, params]) => {
    const name = `${technique[0].toUpperCase()}${technique.slice(1)}Parameters`;
    const titled = { ...params, title: name };
    for (const parameter of Object.values(titled.properties)) delete parameter.title;
    return compile(titled, name, { bannerComment: '', additionalProperties: false, format: true });
  });
  write('parameters', (await Promise.all(texts)).join('\n'));
}

/** What a form can be made of before the engine is there. */
function writeDescription(core) {
  const constants = [
    `export const version: string = ${JSON.stringify(core.version())};`,
    `export const schema: JobSchema = ${core.schema()};`,
    `export const techniques: Technique[] = ${core.techniques()};`,
  ];
  write('description', ["import type { JobSchema, Technique } from './api.js';", '', ...constants, ''].join('\n'));
}

copyLicences();
copyEngine();
const core = await loadEngine();
await writeParameterTypes(core);
writeDescription(core);
execFileSync('npx', ['tsc', '--project', here], { stdio: 'inherit' });
