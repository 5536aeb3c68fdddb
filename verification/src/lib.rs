//! Published and closed-form results that Hammerbeam reproduces; see `tests/`.
