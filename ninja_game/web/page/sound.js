// Plays the sounds of shim/pygame/mixer.py with WebAudio.

const OGG = 0x4f676753; // "OggS"

export class Sounds {
  constructor() {
    this.buffers = []; // by number; null until it is decoded
    this.fetched = {}; // numbers by address
    this.channels = [];
    this.audio = null;
    this.muted = false;
    // Decodes before there is a device.
    this.decoder = new OfflineAudioContext(1, 1, 44100);
  }

  // The number of a sound; -1 for bytes that are none. The browser decodes it.
  add(bytes) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    return bytes.length >= 4 && view.getUint32(0) === OGG ? this.decode(Promise.resolve(bytes.slice().buffer)) : -1;
  }

  // The number of a sound that comes from the host of the page, once; one that does not come is asked for again.
  fetch(url) {
    const got = async () => {
      const answer = navigator.onLine ? await fetch(url) : { ok: false, status: "no network" };
      if (!answer.ok) throw answer.status;
      return answer.arrayBuffer();
    };
    if (!(url in this.fetched)) this.fetched[url] = this.decode(got(), () => delete this.fetched[url]);
    return this.fetched[url];
  }

  decode(coming, failed = () => {}) {
    const number = this.buffers.push(null) - 1;
    coming
      .then((data) => this.decoder.decodeAudioData(data))
      .then((buffer) => (this.buffers[number] = buffer))
      .catch((why) => {
        console.warn("a sound stays silent:", why);
        failed();
      });
    return number;
  }

  // Seconds; 0 while it cannot be heard: not decoded, or nothing pressed yet.
  length(sound) {
    return this.audio && this.buffers[sound] ? this.buffers[sound].duration : 0;
  }

  // Browsers allow sound only after the player pressed something, which Escape and the start of a touch are not.
  unlock() {
    if (!navigator.userActivation.hasBeenActive) return;
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
