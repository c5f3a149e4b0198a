/* The properties of fbsenc: the settings of the encoder, fbs/encoder.h. */
#include "fbsenc.h"

enum {
  PROP_0,
  PROP_QUALITY,
  PROP_BITRATE,
  PROP_EFFORT,
  PROP_TUNE,
  PROP_PATTERNS,
  PROP_FACE,
  PROP_ALLOW_NO_FACE,
  PROP_KEY_INTERVAL,
  PROP_LIVE,
  PROP_DELAY,
  PROP_BUFFER,
  PROP_RESILIENCE,
  PROP_JOIN,
  PROP_START,
  PROP_THREADS,
};

static GType tune_type(void) {
  static gsize type = 0;
  static const GEnumValue values[] = {
      {FBS_TUNE_EYE, "Mouth and eyes that look right", "eye"},
      {FBS_TUNE_PSNR, "The PSNR of the whole frame", "psnr"},
      {0, NULL, NULL},
  };
  if (g_once_init_enter(&type)) g_once_init_leave(&type, g_enum_register_static("GstFbsEncTune", values));
  return type;
}

static GType resilience_type(void) {
  static gsize type = 0;
  static const GEnumValue values[] = {
      {FBS_RESILIENCE_NONE, "Nothing: fewest bits", "none"},
      {FBS_RESILIENCE_PACKET, "Motion goes on; lost packets are to be sent again", "packet"},
      {FBS_RESILIENCE_STRONG, "Motion and patterns go on", "strong"},
      {0, NULL, NULL},
  };
  if (g_once_init_enter(&type))
    g_once_init_leave(&type, g_enum_register_static("GstFbsEncResilience", values));
  return type;
}

/* An encoder that runs follows the link. */
static void follow_bitrate(GstFbsEnc* self) {
  GST_VIDEO_ENCODER_STREAM_LOCK(self);
  if (self->stream.encoder != NULL &&
      fbs_encoder_set_bitrate(self->stream.encoder, self->settings.bitrate) != FBS_OK)
    GST_INFO_OBJECT(self, "the bit rate changes with the next stream: it is not live, or began without one");
  GST_VIDEO_ENCODER_STREAM_UNLOCK(self);
}

/* Members that the properties are; numbers and enumerations are int there, and the bitrate kbit/s. */
static const gsize members[] = {
    [PROP_QUALITY] = offsetof(fbs_encoder_settings, quality),
    [PROP_BITRATE] = offsetof(fbs_encoder_settings, bitrate),
    [PROP_EFFORT] = offsetof(fbs_encoder_settings, effort),
    [PROP_TUNE] = offsetof(fbs_encoder_settings, tune),
    [PROP_PATTERNS] = offsetof(fbs_encoder_settings, patterns),
    [PROP_FACE] = offsetof(fbs_encoder_settings, face),
    [PROP_ALLOW_NO_FACE] = offsetof(fbs_encoder_settings, allow_no_face),
    [PROP_KEY_INTERVAL] = offsetof(fbs_encoder_settings, key_interval),
    [PROP_LIVE] = offsetof(fbs_encoder_settings, live),
    [PROP_DELAY] = offsetof(fbs_encoder_settings, live_delay),
    [PROP_BUFFER] = offsetof(fbs_encoder_settings, live_buffer),
    [PROP_RESILIENCE] = offsetof(fbs_encoder_settings, resilience),
    [PROP_JOIN] = offsetof(fbs_encoder_settings, join),
    [PROP_START] = offsetof(fbs_encoder_settings, start),
    [PROP_THREADS] = offsetof(fbs_encoder_settings, threads),
};

static void set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  void* const member = (guint8*)&GST_FBS_ENC(object)->settings + members[id];
  (void)spec;
  GST_OBJECT_LOCK(object);
  if (G_VALUE_HOLDS_UINT(value))
    *(double*)member = g_value_get_uint(value) / 1000.0;
  else if (G_VALUE_HOLDS_DOUBLE(value))
    *(double*)member = g_value_get_double(value);
  else if (G_VALUE_HOLDS_BOOLEAN(value))
    *(int*)member = g_value_get_boolean(value);
  else
    *(int*)member = G_VALUE_HOLDS_ENUM(value) ? g_value_get_enum(value) : g_value_get_int(value);
  GST_OBJECT_UNLOCK(object);
  if (id == PROP_BITRATE) follow_bitrate(GST_FBS_ENC(object));
}

static void get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  const void* const member = (const guint8*)&GST_FBS_ENC(object)->settings + members[id];
  (void)spec;
  GST_OBJECT_LOCK(object);
  if (G_VALUE_HOLDS_UINT(value))
    g_value_set_uint(value, (guint)(*(const double*)member * 1000 + 0.5));
  else if (G_VALUE_HOLDS_DOUBLE(value))
    g_value_set_double(value, *(const double*)member);
  else if (G_VALUE_HOLDS_BOOLEAN(value))
    g_value_set_boolean(value, *(const int*)member);
  else if (G_VALUE_HOLDS_ENUM(value))
    g_value_set_enum(value, *(const int*)member);
  else
    g_value_set_int(value, *(const int*)member);
  GST_OBJECT_UNLOCK(object);
}

#define PROPERTY_FLAGS (G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_READY)

static void install_int(GObjectClass* type, guint id, const char* name, const char* nick, const char* blurb,
                        gint min, gint max, gint value) {
  g_object_class_install_property(type, id,
                                  g_param_spec_int(name, nick, blurb, min, max, value, PROPERTY_FLAGS));
}

static void install_double(GObjectClass* type, guint id, const char* name, const char* nick,
                           const char* blurb, gdouble max, gdouble value) {
  g_object_class_install_property(type, id,
                                  g_param_spec_double(name, nick, blurb, 0, max, value, PROPERTY_FLAGS));
}

static void install_boolean(GObjectClass* type, guint id, const char* name, const char* nick,
                            const char* blurb) {
  g_object_class_install_property(type, id, g_param_spec_boolean(name, nick, blurb, TRUE, PROPERTY_FLAGS));
}

void gst_fbs_enc_install_properties(GObjectClass* type) {
  type->set_property = set_property;
  type->get_property = get_property;
  install_int(type, PROP_QUALITY, "quality", "Quality", "Quality, where no bit rate is set", 0, 100, 50);
  g_object_class_install_property(
      type, PROP_BITRATE,
      g_param_spec_uint("bitrate", "Bit rate", "Bit/s, from which quality follows (0 = quality decides)", 0,
                        1000000000, 0,
                        G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_PLAYING));
  install_int(type, PROP_EFFORT, "effort", "Effort", "More takes longer and needs fewer bits", 0, 9, 5);
  g_object_class_install_property(
      type, PROP_TUNE,
      g_param_spec_enum("tune", "Tune", "What bytes are spent for; without effect where live is set",
                        tune_type(), FBS_TUNE_EYE, PROPERTY_FLAGS));
  install_int(type, PROP_PATTERNS, "patterns", "Patterns",
              "Pictures of the person that the decoder keeps (0 = chosen by the encoder)", 0, 64, 0);
  install_int(type, PROP_FACE, "face", "Face", "Which face is followed; the largest one is 0", 0, 99, 0);
  install_boolean(type, PROP_ALLOW_NO_FACE, "allow-no-face", "Allow no face",
                  "Encode a video in which no face is found all the same, instead of failing at its end");
  install_double(type, PROP_KEY_INTERVAL, "key-interval", "Key interval",
                 "Seconds between scenes at most, where a viewer can join (0 = up to 40)", 3600, 0);
  install_boolean(type, PROP_LIVE, "live", "Live",
                  "No look-ahead. Otherwise fewer bits are needed, and buffers come up to 40 seconds later");
  install_double(type, PROP_DELAY, "delay", "Delay", "Live: so many seconds of pictures are coded together",
                 40, 0.2);
  install_double(type, PROP_BUFFER, "buffer", "Buffer",
                 "Live, with a bit rate: nothing waits longer to be sent, seconds", 60, 2);
  g_object_class_install_property(
      type, PROP_RESILIENCE,
      g_param_spec_enum("resilience", "Resilience", "Live: what is done to survive lost packets",
                        resilience_type(), FBS_RESILIENCE_NONE, PROPERTY_FLAGS));
  install_double(type, PROP_JOIN, "join", "Join",
                 "Live: seconds within which a viewer can join in the middle of a scene (0 = only where one "
                 "begins)",
                 3600, 0);
  g_object_class_install_property(
      type, PROP_START,
      g_param_spec_double(
          "start", "Start",
          "With a bit rate: the first picture is there after so many seconds of it, coarse if need "
          "be (0 = as fine as the rate as a whole allows, -1 = 1 live, without join and strong resilience)",
          -1, 3600, -1, PROPERTY_FLAGS));
  install_int(type, PROP_THREADS, "threads", "Threads",
              "Live: more than 1 code while the next pictures are analysed (0 = as many as there are cores)",
              0, FBS_MAX_THREADS, 0);
}
