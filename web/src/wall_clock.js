/** The time of a stream without sound: the machine's. */
export class WallClock {
  constructor() {
    this.running = false;
    this.begun = 0;
    this.position = 0;
  }

  /** @param {number} position  seconds of the stream */
  start(position) {
    this.position = position;
    this.begun = performance.now();
    this.running = true;
  }

  stop() {
    this.position = this.time();
    this.running = false;
  }

  /** Seconds of the stream. */
  time() {
    return this.running ? this.position + (performance.now() - this.begun) / 1000 : this.position;
  }
}
