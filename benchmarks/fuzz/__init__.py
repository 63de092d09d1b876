"""The fuzzer: sound files of every format, damaged; each read with an eye on time and memory."""
