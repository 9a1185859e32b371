// Plays the sounds of shim/pygame/mixer.py with WebAudio.

const STEPS = Array.from({ length: 89 }, (_, k) => Math.min(32767, Math.round(7 * 1.1 ** k)));
const CHANGES = [-1, -1, -1, -1, 2, 4, 6, 8];

// Samples (-1 to 1) of a sound that ninja_game/web/sounds.py has made smaller: the same there as `decoded`.
function unpacked(bytes, view) {
  const samples = new Float32Array(view.getUint32(8, true));
  let [value, place] = [0, bytes[12]];
  for (let k = 0; k < samples.length; k++) {
    const nibble = (bytes[13 + (k >> 1)] >> (4 * (k & 1))) & 15;
    const moved = (STEPS[place] * (2 * (nibble & 7) + 1)) >> 3;
    value = Math.max(-32768, Math.min(32767, nibble & 8 ? value - moved : value + moved));
    place = Math.max(0, Math.min(STEPS.length - 1, place + CHANGES[nibble & 7]));
    samples[k] = value / 32768;
  }
  return { rate: view.getUint32(4, true), samples };
}

// Samples (-1 to 1) of such a sound, or of a WAV file of 16 bits, mono; null for anything else.
export function decoded(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  if (bytes.length >= 13 && view.getUint32(0) === 0x4e475331) return unpacked(bytes, view);
  if (bytes.length < 44 || view.getUint32(0) !== 0x52494646) return null;
  const samples = new Float32Array((bytes.length - 44) >> 1);
  for (let k = 0; k < samples.length; k++) samples[k] = view.getInt16(44 + 2 * k, true) / 32768;
  return { rate: view.getUint32(24, true), samples };
}

export class Sounds {
  constructor() {
    this.decoded = []; // by number
    this.buffers = [];
    this.channels = [];
    this.audio = null;
    this.muted = false;
  }

  // The number of a sound; -1 for bytes that are none.
  add(bytes) {
    const sound = decoded(bytes);
    return sound ? this.decoded.push(sound) - 1 : -1;
  }

  // Browsers allow sound only after the player pressed something.
  unlock() {
    if (!this.audio) this.audio = new AudioContext();
    if (this.audio.state === "suspended" && !this.muted) this.audio.resume();
  }

  mute(wanted) {
    this.muted = wanted;
    if (this.audio) wanted ? this.audio.suspend() : this.audio.resume();
  }

  channel(number) {
    if (!this.channels[number]) {
      const merger = this.audio.createChannelMerger(2);
      const [fade, left, right] = [0, 1, 2].map(() => this.audio.createGain());
      fade.connect(left).connect(merger, 0, 0);
      fade.connect(right).connect(merger, 0, 1);
      merger.connect(this.audio.destination);
      this.channels[number] = { fade, left, right, source: null, end: 0 };
    }
    return this.channels[number];
  }

  play(number, sound, loops, fadeMs) {
    if (!this.audio || !this.decoded[sound]) return;
    if (!this.buffers[sound]) {
      const { rate, samples } = this.decoded[sound];
      this.buffers[sound] = this.audio.createBuffer(1, Math.max(1, samples.length), rate);
      this.buffers[sound].copyToChannel(samples, 0);
    }
    const channel = this.channel(number);
    if (channel.source) channel.source.stop();
    const source = this.audio.createBufferSource();
    source.buffer = this.buffers[sound];
    source.loop = loops !== 0;
    const now = this.audio.currentTime;
    channel.end = loops < 0 ? Infinity : now + source.buffer.duration * (loops + 1);
    channel.source = source;
    channel.fade.gain.cancelScheduledValues(now);
    channel.fade.gain.setValueAtTime(fadeMs ? 0 : 1, now);
    if (fadeMs) channel.fade.gain.linearRampToValueAtTime(1, now + fadeMs / 1000);
    source.connect(channel.fade);
    source.start();
    if (loops > 0) source.stop(channel.end);
  }

  stop(number, fadeMs) {
    const channel = this.channels[number];
    if (!channel || !channel.source) return;
    const now = this.audio.currentTime;
    channel.fade.gain.cancelScheduledValues(now);
    channel.fade.gain.setValueAtTime(channel.fade.gain.value, now);
    channel.fade.gain.linearRampToValueAtTime(0, now + fadeMs / 1000);
    channel.source.stop(now + fadeMs / 1000);
    channel.source = null;
    channel.end = 0;
  }

  volume(number, left, right) {
    if (!this.audio) return;
    const channel = this.channel(number);
    channel.left.gain.value = left;
    channel.right.gain.value = right;
  }

  busy(number) {
    const channel = this.channels[number];
    return Boolean(channel && channel.source && this.audio.currentTime < channel.end);
  }
}
