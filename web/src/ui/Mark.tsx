/** Tessera's sign: four stones. */
export const Mark = () => (
  <svg class="mark" viewBox="0 0 32 32" aria-hidden="true">
    <path class="full" d="M3 4l13-1 1 11-13 2z" />
    <path class="soft" d="M18.5 3L29 4.5l-1 13-9-3z" />
    <path class="soft" d="M4 18l9-1.5 5 9-1 4-13-1z" />
    <path class="full" d="M15 16l12 4 1 8.5-9 .5 1-4z" />
  </svg>
);
