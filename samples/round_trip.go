// round_trip WIDTH HEIGHT RATE: round_trip.cpp in Go, which calls C directly (cgo):
//
//	go run round_trip.go 352 288 25 <in.yuv >out.yuv
//
// Memory that C keeps a pointer to between or inside structs comes from C: malloc.
package main

// #cgo pkg-config: fbs-encoder
// #include <stdlib.h>
// #include <fbs/encoder.h>
import "C"

import (
	"bufio"
	"fmt"
	"io"
	"os"
	"strings"
	"unsafe"
)

func check(status C.fbs_status) {
	if status < 0 {
		panic(C.GoString(C.fbs_status_text(status)))
	}
}

func encode(width, height, rate int) (stream []byte) {
	var settings C.fbs_encoder_settings
	C.fbs_encoder_default_settings(&settings, C.sizeof_fbs_encoder_settings)
	settings.format.width, settings.format.height = C.uint32_t(width), C.uint32_t(height)
	settings.format.frame_rate_num = C.uint32_t(rate)
	var encoder *C.fbs_encoder
	check(C.fbs_encoder_open(&encoder, &settings))
	defer C.fbs_encoder_close(&encoder)

	half := (width + 1) / 2
	luma, chroma := width*height, half*((height+1)/2)
	memory := C.CBytes(make([]byte, luma+2*chroma))
	defer C.free(memory)
	samples := unsafe.Slice((*byte)(memory), luma+2*chroma)
	picture := C.fbs_const_picture{width: C.uint32_t(width), height: C.uint32_t(height)}
	for plane, start := range []int{0, luma, luma + chroma} {
		picture.data[plane] = (*C.uint8_t)(unsafe.Add(memory, start))
		picture.stride[plane] = C.ptrdiff_t([]int{width, half, half}[plane])
	}
	for status := C.fbs_status(C.FBS_NEED_DATA); status == C.FBS_NEED_DATA; {
		if _, end := io.ReadFull(os.Stdin, samples); end == nil {
			check(C.fbs_encoder_push(encoder, &picture, 0))
		} else {
			check(C.fbs_encoder_finish(encoder))
		}
		var packet C.fbs_packet
		for status = C.FBS_OK; status == C.FBS_OK; status = C.fbs_encoder_pull(encoder, &packet) {
			stream = append(stream, C.GoBytes(unsafe.Pointer(packet.data), C.int(packet.size))...)
		}
		check(status)
	}
	return stream
}

func decode(stream []byte, out io.Writer) {
	var decoder *C.fbs_decoder
	check(C.fbs_decoder_open(&decoder, nil))
	defer C.fbs_decoder_close(&decoder)
	check(C.fbs_decoder_feed(decoder, (*C.uint8_t)(unsafe.Pointer(&stream[0])), C.size_t(len(stream))))
	check(C.fbs_decoder_finish(decoder))
	for C.fbs_decoder_next(decoder, nil) == C.FBS_OK {
		var picture C.fbs_const_picture
		check(C.fbs_decoder_get_picture(decoder, &picture))
		for plane, less := range []C.uint32_t{0, 1, 1} {
			row := unsafe.Pointer(picture.data[plane])
			for y := C.uint32_t(0); y < (picture.height+less)>>less; y++ {
				out.Write(unsafe.Slice((*byte)(row), (picture.width+less)>>less))
				row = unsafe.Add(row, picture.stride[plane])
			}
		}
	}
}

func main() {
	var width, height, rate int
	fmt.Sscan(strings.Join(os.Args[1:], " "), &width, &height, &rate)
	stream := encode(width, height, rate)
	fmt.Fprintln(os.Stderr, len(stream), "bytes")
	out := bufio.NewWriter(os.Stdout)
	defer out.Flush()
	decode(stream, out)
}
