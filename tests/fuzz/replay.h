// The functions of libFuzzer besides the target itself. Without it, replay.cpp does the same.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/// Changes bytes at random; replay.cpp has its own.
/// @return the new size, at most `room`
std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

/// A target's own mutator and crossover, if it has them (stream_mutator_hooks.cpp); else null.
__attribute__((weak)) std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                                          std::size_t room, unsigned seed);
__attribute__((weak)) std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t size_of_one,
                                                            const std::uint8_t* other,
                                                            std::size_t size_of_other, std::uint8_t* out,
                                                            std::size_t room, unsigned seed);
}
