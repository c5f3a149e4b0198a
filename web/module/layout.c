/* Where src/fbs_module.js finds the members of the structs of include/fbs: a change there stops here. */
#include <fbs/sound.h>
#include <stddef.h>

#define MEMBER(type, member, offset) _Static_assert(offsetof(type, member) == (offset), #type "." #member)
#define SIZE(type, bytes) _Static_assert(sizeof(type) == (bytes), "size of " #type)

MEMBER(fbs_decoder_settings, max_pixels, 8);
SIZE(fbs_decoder_settings, 40);

MEMBER(fbs_picture_info, time, 8);
MEMBER(fbs_picture_info, duration, 16);
MEMBER(fbs_picture_info, held, 20);
MEMBER(fbs_picture_info, new_scene, 24);
MEMBER(fbs_picture_info, quality, 28);

SIZE(fbs_format, 32); /* eight numbers of four bytes */

MEMBER(fbs_const_picture, data, 8);

MEMBER(fbs_face_state, eye_distance, 20);
SIZE(fbs_face_edit, 28);
SIZE(fbs_landmark, 12);

SIZE(fbs_sound_info, 24);
MEMBER(fbs_sound_info, bytes, 8);
MEMBER(fbs_sound_info, shown_until, 16);

MEMBER(fbs_samples, sample_rate, 8);
MEMBER(fbs_samples, channels, 12);
MEMBER(fbs_samples, count, 16);
MEMBER(fbs_samples, data, 20);
