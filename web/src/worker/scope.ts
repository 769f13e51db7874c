// The part of a dedicated worker's global scope that we use; TypeScript's own description excludes that of a page.

interface WorkerScope {
  postMessage(message: unknown, transfer?: Transferable[]): void;
  onmessage: ((event: MessageEvent) => void) | null;
  requestAnimationFrame(callback: (time: number) => void): number;
}

export const scope = globalThis as unknown as WorkerScope;
