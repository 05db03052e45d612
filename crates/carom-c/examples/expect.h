// Checks of the programs that call every function.

#ifndef EXPECT_H
#define EXPECT_H

#include <carom.h>
#include <stdio.h>
#include <stdlib.h>

#define EXPECT(condition)                                                                     \
    do {                                                                                      \
        if (!(condition)) {                                                                   \
            fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition);            \
            fprintf(stderr, "last error: %s\n", carom_last_error());                          \
            exit(1);                                                                          \
        }                                                                                     \
    } while (0)
#define OK(call) EXPECT((call) == CAROM_STATUS_OK)
#define FAILS(status, call) EXPECT((call) == (status) && carom_last_error()[0] != '\0')

#endif
