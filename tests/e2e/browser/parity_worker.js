const program = '/bin/tessera_parity_tests.js';
self.Module = {
  mainScriptUrlOrBlob: program,
  locateFile: (name) => `/bin/${name}`,
  print: (line) => postMessage(line),
  printErr: (line) => postMessage(line),
};
importScripts(program);
