// The parts of the film library that are needed: a separate module, so that only these are fetched,
// and only with the first film.

export {
  BufferTarget,
  Mp4OutputFormat,
  Output,
  Quality,
  VideoSample,
  VideoSampleSource,
  WebMOutputFormat,
  getFirstEncodableVideoCodec,
} from "mediabunny";
