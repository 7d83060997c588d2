//! Triangle surfaces of vessels: reading, repair, openings, signed distance.
