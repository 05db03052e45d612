// What films need of the library that writes them: a module of its own, so that only this is
// fetched, and only with the first film.

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
