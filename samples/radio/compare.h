/* What a stream is worth behind the radio. */
#ifndef RADIO_COMPARE_H
#define RADIO_COMPARE_H

/* Prints how many packets came whole, and how many pictures are exact, concealed (other than those sent, by
 * what was lost) and frozen (missing: a viewer sees the one before). Returns the program's exit code. */
int compare_streams(const char* sent_name, const char* received_name);

#endif
