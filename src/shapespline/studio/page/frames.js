// Drawing at most once a frame, however often it is asked for.

/** @param {() => void} act @returns {() => void} asks for it */
export function onceAFrame(act) {
  let pending = false;
  return () => {
    if (pending) return;
    pending = true;
    requestAnimationFrame(() => {
      pending = false;
      act();
    });
  };
}
