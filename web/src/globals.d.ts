/** The root package's version, put in by Vite. */
declare const __TESSERA_VERSION__: string;
