// Plays the sounds of shim/pygame/mixer.py with WebAudio.

const OGG = 0x4f676753; // "OggS"

const LOST = 256; // first samples that may be missing
const SEAM = 1024; // at the end of a loop so many less LOST become those before it

// Samples of an Ogg file, by the last of its pages.
function lengthOf(data) {
  const view = new DataView(data);
  let at = data.byteLength - 14;
  while (at > 0 && view.getUint32(at) !== OGG) at--;
  return at > 0 ? view.getUint32(at + 6, true) : 0;
}

export class Sounds {
  constructor() {
    this.buffers = []; // by number; null until it is decoded
    this.channels = [];
    this.audio = null;
    this.muted = false;
    this.mended = new Set(); // numbers of the sounds that can loop
    // Decodes before there is a device.
    this.decoder = new OfflineAudioContext(1, 1, 44100);
  }

  // The number of a sound; -1 for bytes that are none. The browser decodes it.
  add(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    return bytes.length >= 4 && view.getUint32(0) === OGG ? this.decode(Promise.resolve(bytes.slice().buffer)) : -1;
  }

  // The number of a sound that comes from the host of the page; one that does not come stays silent.
  fetch(url) {
    return this.decode(
      fetch(url).then((answer) => (answer.ok ? answer.arrayBuffer() : Promise.reject(answer.status))),
    );
  }

  decode(coming) {
    const number = this.buffers.push(null) - 1;
    coming
      .then(async (data) => {
        const length = lengthOf(data);
        this.buffers[number] = this.whole(await this.decoder.decodeAudioData(data), length);
      })
      .catch((why) => console.warn("a sound stays silent:", why));
    return number;
  }

  // Browsers drop the first samples, not always as many: they come back as silence, so that layers stay in step.
  whole(decoded, length) {
    if (decoded.length >= length) return decoded;
    const buffer = this.decoder.createBuffer(1, length, decoded.sampleRate);
    buffer.copyToChannel(decoded.getChannelData(0), 0, length - decoded.length);
    return buffer;
  }

  // Have a sound loop without its first samples and without a seam: its end becomes what comes before the place SEAM.
  mend(sound) {
    if (this.mended.has(sound)) return;
    this.mended.add(sound);
    const samples = this.buffers[sound].getChannelData(0);
    for (let k = LOST; k < SEAM; k++) {
      const share = (k - LOST) / (SEAM - LOST);
      const end = samples.length - SEAM + k;
      samples[end] = samples[end] * (1 - share) + samples[k] * share;
    }
  }

  // Seconds; 0 while it is not decoded.
  length(sound) {
    return this.buffers[sound] ? this.buffers[sound].duration : 0;
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
    if (!this.audio || !this.buffers[sound]) return;
    const channel = this.channel(number);
    if (channel.source) channel.source.stop();
    const source = this.audio.createBufferSource();
    source.buffer = this.buffers[sound];
    source.loop = loops !== 0;
    if (source.loop) {
      this.mend(sound);
      source.loopStart = SEAM / source.buffer.sampleRate;
      source.loopEnd = source.buffer.duration;
    }
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
